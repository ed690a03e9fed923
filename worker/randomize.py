"""Drawing a scene: every random value of a picture, from the job's own streams, one stream per stage."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from farm.category import Background, Disposition, Light
from farm.header import DatasetHeader, HdriRef
from farm.job import Job
from farm.light_ranges import LampRanges
from farm.lights import AreaLamp, HdriWorld, PointLamp
from farm.looks import CableMaterial, Rgb
from farm.photograph import Camera
from farm.ranges import BEND_KNOTS, CableRanges, FloorRanges, PlacementRanges, Ranges, WindRanges
from farm.scene import Cable, Floor, Friction, Gust, Scene, Wind
from farm.seeds import Stage, generator

GUSTS = 3
"""Swings that are laid over the wind's mean speed."""

Streams = Callable[[Stage], np.random.Generator]


@dataclass(frozen=True, slots=True)
class _Placement:
    """Where one cable starts, in the horizontal plane."""

    x_m: float
    y_m: float
    rotation_deg: float
    bends_per_m: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class _Substance:
    """What one cable is made of."""

    youngs_modulus_pa: float
    density_kg_m3: float


def draw_scene(header: DatasetHeader, job: Job, attempt: int) -> Scene:
    """Draw the scene of one attempt at a job.

    The same header, job and attempt give the same scene on every machine.
    """

    def streams(stage: Stage) -> np.random.Generator:
        return generator(header.spec.seed, job.category, job.index, attempt, stage)

    ranges, traits = header.spec.ranges, job.category.traits
    count_and_mass = streams(Stage.CABLES)
    count = _level(count_and_mass, ranges.cable.count)
    vertex_mass = _uniform(count_and_mass, ranges.cable.vertex_mass)
    friction = Friction(
        floor=_uniform(count_and_mass, ranges.cable.friction_floor),
        cable=_uniform(count_and_mass, ranges.cable.friction_cable),
    )
    substances = [_draw_substance(ranges.cable, count_and_mass) for _ in range(count)]
    lamps = (_draw_lamp(ranges.lamp, streams(Stage.LIGHT)),) if traits.light is Light.CONCENTRATED else ()
    return Scene(
        attempt=attempt,
        cables=_draw_cables(ranges, traits.disposition, substances, streams),
        vertex_mass=vertex_mass,
        friction=friction,
        wind=_draw_wind(ranges.wind, streams(Stage.WIND)),
        floor=_draw_floor(ranges.floor, header, streams(Stage.FLOOR))
        if traits.background is Background.FLOOR
        else None,
        lamps=lamps,
        hdri_world=None if lamps else _draw_world(header, traits.background, streams(Stage.WORLD)),
        camera=_draw_camera(ranges, streams(Stage.CAMERA)),
        render_seed=int(streams(Stage.RENDER).integers(2**31)),
    )


def _uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    return float(rng.uniform(*bounds))


def _level(rng: np.random.Generator, bounds: tuple[int, int]) -> int:
    return int(rng.integers(bounds[0], bounds[1], endpoint=True))


def _rgb(rng: np.random.Generator, bounds: tuple[int, int]) -> Rgb:
    return (_level(rng, bounds), _level(rng, bounds), _level(rng, bounds))


def _draw_substance(ranges: CableRanges, rng: np.random.Generator) -> _Substance:
    low, high = ranges.youngs_modulus_pa
    return _Substance(
        youngs_modulus_pa=float(np.clip(np.exp(rng.uniform(np.log(low), np.log(high))), low, high)),
        density_kg_m3=_uniform(rng, ranges.density_kg_m3),
    )


def _draw_cables(
    ranges: Ranges, disposition: Disposition, substances: list[_Substance], streams: Streams
) -> tuple[Cable, ...]:
    place = _PLACERS[disposition]
    placements = place(ranges.placement, len(substances), streams(Stage.PLACEMENT))
    material_rng = streams(Stage.CABLE_MATERIAL)
    start, spacing = ranges.placement.drop_height_m, ranges.placement.spacing_m
    return tuple(
        Cable(
            diameter_m=ranges.cable.diameter_m[0],
            length_m=ranges.cable.length_m[0],
            x_m=placement.x_m,
            y_m=placement.y_m,
            start_height_m=start + spacing * level,
            rotation_deg=placement.rotation_deg,
            bends_per_m=placement.bends_per_m,
            youngs_modulus_pa=substance.youngs_modulus_pa,
            density_kg_m3=substance.density_kg_m3,
            material=_draw_material(ranges.cable, material_rng),
        )
        for level, (placement, substance) in enumerate(zip(placements, substances, strict=True))
    )


def _place_free(ranges: PlacementRanges, count: int, rng: np.random.Generator) -> list[_Placement]:
    return [
        _Placement(
            x_m=_uniform(rng, ranges.free_x_m),
            y_m=_uniform(rng, ranges.free_y_m),
            rotation_deg=_uniform(rng, ranges.free_rotation_deg),
            bends_per_m=_bends(ranges, rng),
        )
        for _ in range(count)
    ]


def _place_aligned(ranges: PlacementRanges, count: int, rng: np.random.Generator) -> list[_Placement]:
    """One bearing and one natural bend for the whole bundle; each cable deviates from both a little."""
    bearing = _uniform(rng, ranges.aligned_bearing_deg)
    common = np.array(_bends(ranges, rng))
    return [
        _Placement(
            x_m=_uniform(rng, ranges.aligned_x_m),
            y_m=_uniform(rng, ranges.aligned_y_m),
            rotation_deg=bearing + _uniform(rng, ranges.aligned_deviation_deg),
            bends_per_m=tuple((0.7 * common + 0.3 * np.array(_bends(ranges, rng))).tolist()),
        )
        for _ in range(count)
    ]


_PLACERS: Mapping[Disposition, Callable[[PlacementRanges, int, np.random.Generator], list[_Placement]]] = {
    Disposition.FREE: _place_free,
    Disposition.ALIGNED: _place_aligned,
}


def _bends(ranges: PlacementRanges, rng: np.random.Generator) -> tuple[float, ...]:
    return tuple(rng.uniform(*ranges.bend_per_m, size=BEND_KNOTS).tolist())


def _draw_material(ranges: CableRanges, rng: np.random.Generator) -> CableMaterial:
    offset = ranges.dirt_offset
    return CableMaterial(
        colour=_rgb(rng, ranges.colour),
        dirt_colour=_rgb(rng, ranges.dirt_colour),
        dirt_position=_uniform(rng, ranges.dirt_position),
        dirt_mapping=(_uniform(rng, offset), _uniform(rng, offset), _uniform(rng, offset)),
        dirt_offset=_uniform(rng, offset),
        reflection_position=_uniform(rng, ranges.reflection_position),
    )


def _draw_wind(ranges: WindRanges, rng: np.random.Generator) -> Wind:
    strength = _uniform(rng, ranges.strength)
    return Wind(
        bearing_deg=_uniform(rng, ranges.bearing_deg),
        distance=_uniform(rng, ranges.distance),
        height=_uniform(rng, ranges.height),
        tilt_deg=_uniform(rng, ranges.tilt_deg),
        strength=strength,
        flow=strength * ranges.flow_per_strength,
        speed_m_s=strength * ranges.speed_per_strength_m_s,
        gusts=tuple(_draw_gust(ranges, rng) for _ in range(GUSTS)),
    )


def _draw_gust(ranges: WindRanges, rng: np.random.Generator) -> Gust:
    return Gust(
        share=_uniform(rng, ranges.gust_share),
        period_s=_uniform(rng, ranges.gust_period_s),
        phase_deg=float(rng.uniform(0.0, 360.0)),
    )


def _draw_floor(ranges: FloorRanges, header: DatasetHeader, rng: np.random.Generator) -> Floor:
    return Floor(
        texture=header.surfaces[int(rng.integers(len(header.surfaces)))].name,
        offset_x=_uniform(rng, ranges.offset_x),
        offset_y=_uniform(rng, ranges.offset_y),
        rotation_deg=_uniform(rng, ranges.rotation_deg),
        scale=_uniform(rng, ranges.scale),
    )


def _draw_lamp(ranges: LampRanges, rng: np.random.Generator) -> PointLamp | AreaLamp:
    if rng.random() < ranges.area_share:
        side = -1.0 if rng.random() < 0.5 else 1.0
        return AreaLamp(x_m=side * _uniform(rng, ranges.area_distance_m), power_w=_uniform(rng, ranges.area_power_w))
    return PointLamp(
        bearing_deg=_uniform(rng, ranges.point_bearing_deg),
        radius_m=_uniform(rng, ranges.point_radius_m),
        height_m=_uniform(rng, ranges.point_height_m),
        power_w=_uniform(rng, ranges.point_power_w),
        size_m=_uniform(rng, ranges.point_size_m),
    )


def _draw_world(header: DatasetHeader, background: Background, rng: np.random.Generator) -> HdriWorld:
    ranges = header.spec.ranges.world
    backdrops = [hdri for hdri in header.hdris if hdri.backdrop] or list(header.hdris)
    drawn = backdrops[int(rng.integers(len(backdrops)))]
    rotation = _uniform(rng, ranges.rotation_deg)
    brightness = _uniform(rng, ranges.dark_brightness)
    tilt = float(ranges.close_tilts_deg[int(rng.integers(len(ranges.close_tilts_deg)))])
    # Every value is drawn whatever the category, so that the streams of two categories stay comparable.
    hdri = _fixed_hdri(header) if background is Background.FLOOR else drawn
    return HdriWorld(
        hdri=hdri.name,
        rotation_deg=rotation,
        tilt_deg=tilt if background is Background.FLOOR else 90.0,
        brightness=brightness if hdri.dark else 0.0,
    )


def _fixed_hdri(header: DatasetHeader) -> HdriRef:
    """The one HDRI that lights all close pictures without a lamp: the named one, else the first."""
    name = header.spec.close_distributed_hdri
    return next((hdri for hdri in header.hdris if hdri.name == name), header.hdris[0])


def _draw_camera(ranges: Ranges, rng: np.random.Generator) -> Camera:
    heights = ranges.camera.heights_m
    return Camera(height_m=heights[int(rng.integers(len(heights)))], f_number=ranges.camera.f_number[0])
