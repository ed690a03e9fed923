"""Drawing what is under the cables, what lights them, and what is behind them."""

from dataclasses import dataclass

import numpy as np

from farm.category import Background
from farm.header import DatasetHeader, HdriRef
from farm.light_ranges import LampRanges, StudioRanges
from farm.lights import AreaLamp, GreyWorld, HdriWorld, Lamp, PointLamp, StudioLamp
from farm.ranges import FloorRanges, WearRanges, WindRanges
from farm.scene import Floor, Gust, JointFill, Plate, Wear, Wind
from worker.draws.values import chance, level, log_uniform, pattern_seed, uniform

OVER_FLOORS = "sunrise"
"""Of Blender's HDRIs the one under which floors are as bright, and have as much contrast, as in published examples."""

GUSTS = 3
"""Swings that are laid over the wind's mean speed."""


@dataclass(frozen=True, slots=True)
class Lighting:
    """Lamps and what is about them; None is the template's own grey."""

    lamps: tuple[Lamp, ...]
    grey_world: GreyWorld | None


NO_LAMPS = Lighting((), None)


def draw_wind(ranges: WindRanges, rng: np.random.Generator) -> Wind:
    """Draw the wind and its gusts."""
    strength = uniform(rng, ranges.strength)
    return Wind(
        bearing_deg=uniform(rng, ranges.bearing_deg),
        distance=uniform(rng, ranges.distance),
        height=uniform(rng, ranges.height),
        tilt_deg=uniform(rng, ranges.tilt_deg),
        strength=strength,
        flow=strength * ranges.flow_per_strength,
        speed_m_s=strength * ranges.speed_per_strength_m_s,
        gusts=tuple(_draw_gust(ranges, rng) for _ in range(GUSTS)),
    )


def _draw_gust(ranges: WindRanges, rng: np.random.Generator) -> Gust:
    return Gust(
        share=uniform(rng, ranges.gust_share),
        period_s=uniform(rng, ranges.gust_period_s),
        phase_deg=float(rng.uniform(0.0, 360.0)),
    )


def draw_floor(
    ranges: FloorRanges, header: DatasetHeader, rng: np.random.Generator, wear_rng: np.random.Generator
) -> Floor:
    """Draw a surface, how it lies, and what it has been through."""
    drawn = header.surfaces[int(rng.integers(len(header.surfaces)))]
    light = [surface for surface in header.surfaces if surface.light] or list(header.surfaces)
    lighter = light[int(wear_rng.integers(len(light)))]
    return Floor(
        texture=(lighter if chance(wear_rng, ranges.light_share) else drawn).name,
        offset_x=uniform(rng, ranges.offset_x),
        offset_y=uniform(rng, ranges.offset_y),
        rotation_deg=uniform(rng, ranges.rotation_deg),
        scale=uniform(rng, ranges.scale),
        wear=_draw_wear(ranges.wear, wear_rng),
    )


def _draw_wear(ranges: WearRanges, rng: np.random.Generator) -> Wear | None:
    if not chance(rng, ranges.share):
        return None
    stained, scratched, dusty = (
        chance(rng, share) for share in (ranges.stained_share, ranges.scratched_share, ranges.dusty_share)
    )
    stains, scratches, dust = (
        uniform(rng, ranges.stains),
        uniform(rng, ranges.scratches),
        uniform(rng, ranges.dust),
    )
    red, green, blue = (2.0 ** uniform(rng, ranges.tint_ev) for _ in range(3))
    worn = Wear(
        brightness=2.0 ** uniform(rng, ranges.brightness_ev),
        tint=(red, green, blue),
        saturation=uniform(rng, ranges.saturation),
        contrast=uniform(rng, ranges.contrast),
        stains=stains if stained else 0.0,
        scratches=scratches if scratched else 0.0,
        dust=dust if dusty else 0.0,
        mirrored=chance(rng, 0.5),
        pattern_seed=pattern_seed(rng),
    )
    # Drawn last, and always, so that joints move no other draw.
    joints = _draw_joint_fill(ranges, rng)
    return worn.model_copy(update={"joints": joints}) if chance(rng, ranges.refilled_share) else worn


def _draw_joint_fill(ranges: WearRanges, rng: np.random.Generator) -> JointFill:
    level, warmth = log_uniform(rng, ranges.joint_albedo), uniform(rng, ranges.joint_warmth_ev)
    return JointFill(
        albedo=(min(1.0, level * 2.0**warmth), level, min(1.0, level / 2.0**warmth)),
        cover=uniform(rng, ranges.joint_cover),
        spread_m=uniform(rng, ranges.joint_spread_m),
    )


def draw_lamps(lamp: LampRanges, studio: StudioRanges, rng: np.random.Generator) -> Lighting:
    """Draw the lamps of a concentrated light and the grey world about them."""
    published = _draw_published(lamp, rng)
    if not chance(rng, studio.share):
        return Lighting((published,), None)
    lamps = tuple(_draw_studio_lamp(studio, rng) for _ in range(level(rng, studio.count)))
    grey = GreyWorld(radiance=log_uniform(rng, studio.grey), temperature_k=uniform(rng, studio.grey_temperature_k))
    return Lighting(lamps, grey)


def _draw_studio_lamp(ranges: StudioRanges, rng: np.random.Generator) -> StudioLamp:
    distance = log_uniform(rng, ranges.distance_m)
    return StudioLamp(
        bearing_deg=float(rng.uniform(0.0, 360.0)),
        elevation_deg=uniform(rng, ranges.elevation_deg),
        distance_m=distance,
        irradiance_w_m2=uniform(rng, ranges.irradiance_w_m2),
        size_m=log_uniform(rng, ranges.size_share) * distance,
        temperature_k=uniform(rng, ranges.temperature_k),
    )


def _draw_published(ranges: LampRanges, rng: np.random.Generator) -> PointLamp | AreaLamp:
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


def draw_plate(header: DatasetHeader, rng: np.random.Generator) -> Plate | None:
    """Draw which of the user's photographs is behind the cables, and what part of it; None where none is."""
    ranges = header.spec.ranges.plate
    if not header.plates or not chance(rng, ranges.share):
        return None
    return Plate(
        name=header.plates[int(rng.integers(len(header.plates)))].name,
        x=float(rng.random()),
        y=float(rng.random()),
        zoom=uniform(rng, ranges.zoom),
        mirror=chance(rng, 0.5),
        blur_px=uniform(rng, ranges.blur_px) * header.spec.resolution / 512,
    )


def draw_world(header: DatasetHeader, background: Background, rng: np.random.Generator) -> HdriWorld:
    """Draw the HDRI, its turn and its brightness."""
    ranges = header.spec.ranges.world
    backdrops = [hdri for hdri in header.hdris if hdri.backdrop] or list(header.hdris)
    drawn = backdrops[int(rng.integers(len(backdrops)))]
    rotation = uniform(rng, ranges.rotation_deg)
    brightness = uniform(rng, ranges.dark_brightness)
    tilt = float(ranges.close_tilts_deg[int(rng.integers(len(ranges.close_tilts_deg)))])
    # Every value is drawn whatever the category, so that the streams of two categories stay comparable.
    over_floor = background is Background.FLOOR
    hdri = _fixed_hdri(header) if over_floor and ranges.one_over_floors else drawn
    return HdriWorld(
        hdri=hdri.name,
        rotation_deg=rotation,
        tilt_deg=tilt if over_floor else 90.0,
        brightness=brightness if hdri.dark else 0.0,
    )


def _fixed_hdri(header: DatasetHeader) -> HdriRef:
    """The one HDRI that lights all close pictures without a lamp: the named one, else `OVER_FLOORS`, else the first."""
    name = header.spec.close_distributed_hdri or OVER_FLOORS
    return next((hdri for hdri in header.hdris if hdri.name == name), header.hdris[0])
