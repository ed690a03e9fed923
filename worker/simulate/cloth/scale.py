"""Between metres and seconds of the picture and the units of the fall.

Lengths: a cable's radius is `RADIUS_UNITS` units of the fall, since the cloth's self-collision keeps surfaces at
most 0.2 units apart. Time: gravity is 9.81 in both, so a unit of time is sqrt(unit of length) (Froude scaling), and the
fall in the units' world is the true fall slowed down.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from farm.scene.physics import GRAVITY_M_S2

RADIUS_UNITS = 0.09
"""A cable's radius in units of the fall. Measured: loaded contacts of cloth that is kept 0.2 apart settle at 0.18 to
0.2, so that cables of radius 0.09 touch."""

GRAVITY = GRAVITY_M_S2
"""Gravity in units of the fall per its unit of time squared: the number that it is in metres and seconds."""

FRAME_TIME_UNITS = 1.0 / 31.6
"""Units of time in a frame of the cloth's clock, which does not follow the scene's frames per second."""


@dataclass(frozen=True, slots=True)
class FallScale:
    """The scale of one scene.

    Attributes:
        unit_m: metres in a unit of the fall.
    """

    unit_m: float

    @classmethod
    def for_radius(cls, radius_m: float) -> Self:
        """The scale at which a cable of this radius has `RADIUS_UNITS`."""
        return cls(unit_m=radius_m / RADIUS_UNITS)

    @property
    def frame_s(self) -> float:
        """True seconds in a frame of the cloth's clock."""
        return FRAME_TIME_UNITS * float(np.sqrt(self.unit_m))
