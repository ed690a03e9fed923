"""The ranges of the lamps that light a scene.

Sizes are metres, angles degrees. The published ranges are those of `LampRanges`; the others are off unless a style
turns them on.
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
    """The one lamp of a concentrated light: a point or an area light, distances in metres."""

    area_share: Fraction = 0.5
    point_bearing_deg: Range = (0.0, 360.0)
    point_radius_m: PositiveRange = (5.0, 6.5)
    point_height_m: PositiveRange = (5.0, 6.5)
    point_power_w: NotNegativeRange = (800.0, 1500.0)
    point_size_m: PositiveRange = (0.1, 2.0)
    area_distance_m: PositiveRange = (4.0, 15.0)
    area_power_w: NotNegativeRange = (400.0, 1800.0)


class StudioRanges(Model):
    """Lamps of any colour, size and number, beside grey surroundings of any strength.

    Attributes:
        share: of the pictures under lamps that have these instead of the published one.
        count: of lamps.
        elevation_deg: above the floor, seen from the cables.
        distance_m: from the cables.
        size_share: diameter over distance, drawn evenly in its logarithm: small ones throw hard shadows.
        irradiance_w_m2: at the cables, of each lamp.
        temperature_k: of its colour.
        grey: radiance of the surroundings, drawn evenly in its logarithm.
        grey_temperature_k: of their colour.
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
