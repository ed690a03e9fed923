"""What acts on cables while they fall: friction and wind."""

from typing import Annotated

from pydantic import Field

from farm.model import Model

GRAVITY_M_S2 = 9.81
"""The acceleration of gravity with which every cable falls."""


class Gust(Model):
    """One swing of the wind's speed: `share` of the mean, as a sine of the given period and phase."""

    share: Annotated[float, Field(ge=0, le=1)]
    period_s: Annotated[float, Field(gt=0)]
    phase_deg: float


class Friction(Model):
    """Coulomb's coefficients, for a cable on the floor and on another cable."""

    floor: Annotated[float, Field(ge=0)]
    cable: Annotated[float, Field(ge=0)]


class Wind(Model):
    """The wind that pushes the cables while they fall.

    The bearing is where it comes from, as seen from the cables; a tilt of 90 degrees blows level, less blows up.
    Distance, height, strength and flow are those of a wind field in the cloth's own units; `speed_m_s` and `gusts`
    are what the rod solver takes.
    """

    bearing_deg: float
    distance: float
    height: float
    tilt_deg: float
    strength: float
    flow: float
    speed_m_s: Annotated[float, Field(ge=0)]
    gusts: tuple[Gust, ...]
