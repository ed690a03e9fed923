"""The friction and the wind that act on cables while they fall."""

from typing import Annotated

from pydantic import Field

from farm.model import Model

GRAVITY_M_S2 = 9.81
"""The acceleration of gravity with which every cable falls."""


class Gust(Model):
    """One oscillation of the wind's speed, a sine.

    Attributes:
        share: amplitude, as a share of the wind's mean speed.
        period_s: period in seconds.
        phase_deg: phase at the start of the fall, in degrees.
    """

    share: Annotated[float, Field(ge=0, le=1)]
    period_s: Annotated[float, Field(gt=0)]
    phase_deg: float


class Friction(Model):
    """Coulomb's coefficients of friction.

    Attributes:
        floor: coefficient between a cable and the floor.
        cable: coefficient between two cables.
    """

    floor: Annotated[float, Field(ge=0)]
    cable: Annotated[float, Field(ge=0)]


class Wind(Model):
    """The wind that pushes the cables while they fall.

    The cloth takes distance, height, strength and flow, those of a Blender wind field in the fall's own units; the rod
    solver takes `speed_m_s` and `gusts`.

    Attributes:
        bearing_deg: bearing of the wind's source from the cables, in degrees from the x axis.
        distance: horizontal distance of the wind field.
        height: height of the wind field.
        tilt_deg: angle between the wind's direction and straight up, in degrees: 90 blows level, less blows upwards.
        strength: strength of the wind field.
        flow: Blender's setting that turns the field's force into a speed of the air.
        speed_m_s: mean speed of the air, in m/s.
        gusts: oscillations of the speed, which add up.
    """

    bearing_deg: float
    distance: float
    height: float
    tilt_deg: float
    strength: float
    flow: float
    speed_m_s: Annotated[float, Field(ge=0)]
    gusts: tuple[Gust, ...]
