"""The ranges of the lamps that light a scene.

Sizes are in metres, angles in degrees. `LampRanges` has the published ranges; the others are off unless a style turns
them on.
"""

from farm.model import Model
from farm.spec.ranges.types import (
    ElevationRange,
    Fraction,
    LampCountRange,
    NotNegativeRange,
    PositiveRange,
    Range,
    TemperatureRange,
)


class LampRanges(Model):
    """The ranges of the one published lamp of a concentrated light; `farm.scene.light` explains each value.

    Attributes:
        area_share: share of the pictures with an area light; the others have a point light.
        area_distance_m: horizontal distance of an area light from the cables, to either side.
    """

    area_share: Fraction = 0.5
    point_bearing_deg: Range = (0.0, 360.0)
    point_radius_m: PositiveRange = (5.0, 6.5)
    point_height_m: PositiveRange = (5.0, 6.5)
    point_power_w: NotNegativeRange = (800.0, 1500.0)
    point_size_m: PositiveRange = (0.1, 2.0)
    area_distance_m: PositiveRange = (4.0, 15.0)
    area_power_w: NotNegativeRange = (400.0, 1800.0)


class StudioRanges(Model):
    """The ranges of studio lamps, of any colour, size and number, beside grey surroundings of any strength.

    Attributes:
        share: share of the pictures under lamps that have these instead of the published one.
        count: number of lamps.
        elevation_deg: angle of a lamp above the floor, seen from the cables.
        distance_m: distance of a lamp from the cables, sampled log-uniformly.
        size_share: diameter of a lamp over its distance, sampled log-uniformly: small lamps throw hard shadows.
        irradiance_w_m2: irradiance of each lamp at the cables, in W/m2.
        temperature_k: colour temperature of a lamp, in kelvins.
        grey: radiance of the surroundings, sampled log-uniformly.
        grey_temperature_k: colour temperature of the surroundings, in kelvins.
    """

    share: Fraction = 0.0
    count: LampCountRange = (1, 3)
    elevation_deg: ElevationRange = (25.0, 90.0)
    distance_m: PositiveRange = (0.5, 4.0)
    size_share: PositiveRange = (0.02, 0.6)
    irradiance_w_m2: NotNegativeRange = (0.5, 4.0)
    temperature_k: TemperatureRange = (2700.0, 7500.0)
    grey: PositiveRange = (0.03, 0.6)
    grey_temperature_k: TemperatureRange = (4000.0, 8000.0)
