"""Samples the lamps and the grey world around them."""

from dataclasses import dataclass

import numpy as np

from farm.scene.light import AreaLamp, GreyWorld, Lamp, PointLamp, StudioLamp
from farm.spec.ranges.light import LampRanges, StudioRanges
from worker.sample.values import chance, level, log_uniform, uniform


@dataclass(frozen=True, slots=True)
class Lighting:
    """The lamps of a scene and the light around them.

    Attributes:
        lamps: lamps; none if an HDRI lights the scene.
        grey_world: light around the lamps; None for the template's own grey.
    """

    lamps: tuple[Lamp, ...]
    grey_world: GreyWorld | None


NO_LAMPS = Lighting((), None)


def sample_lamps(lamp: LampRanges, studio: StudioRanges, rng: np.random.Generator) -> Lighting:
    """Sample the lamps of a concentrated light and the grey world around them.

    Args:
        lamp: ranges of the one published lamp.
        studio: ranges of studio lamps, which a share of the pictures has in its place.
        rng: random generator of the light.
    """
    published = _sample_published(lamp, rng)
    if not chance(rng, studio.share):
        return Lighting((published,), None)
    lamps = tuple(_sample_studio_lamp(studio, rng) for _ in range(level(rng, studio.count)))
    grey = GreyWorld(radiance=log_uniform(rng, studio.grey), temperature_k=uniform(rng, studio.grey_temperature_k))
    return Lighting(lamps, grey)


def _sample_studio_lamp(ranges: StudioRanges, rng: np.random.Generator) -> StudioLamp:
    distance = log_uniform(rng, ranges.distance_m)
    return StudioLamp(
        bearing_deg=float(rng.uniform(0.0, 360.0)),
        elevation_deg=uniform(rng, ranges.elevation_deg),
        distance_m=distance,
        irradiance_w_m2=uniform(rng, ranges.irradiance_w_m2),
        size_m=log_uniform(rng, ranges.size_share) * distance,
        temperature_k=uniform(rng, ranges.temperature_k),
    )


def _sample_published(ranges: LampRanges, rng: np.random.Generator) -> PointLamp | AreaLamp:
    if rng.random() < ranges.area_share:
        side = -1.0 if rng.random() < 0.5 else 1.0
        return AreaLamp(x_m=side * uniform(rng, ranges.area_distance_m), power_w=uniform(rng, ranges.area_power_w))
    return PointLamp(
        bearing_deg=uniform(rng, ranges.point_bearing_deg),
        radius_m=uniform(rng, ranges.point_radius_m),
        height_m=uniform(rng, ranges.point_height_m),
        power_w=uniform(rng, ranges.point_power_w),
        size_m=uniform(rng, ranges.point_size_m),
    )
