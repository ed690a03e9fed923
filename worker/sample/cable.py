"""Samples the cables: their thickness and stiffness, their start, and their look."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from farm.scene.cable import Cable, CableMaterial
from farm.scene.camera import Camera
from farm.spec.category import Disposition
from farm.spec.ranges.all import Ranges
from farm.spec.ranges.cable import CableRanges
from farm.spec.ranges.placement import BEND_KNOTS, SPACING_DIAMETERS, PlacementRanges
from worker.sample.cable_curve import Course, sample_course
from worker.sample.cable_kind import CableKind, sample_ends, sample_kinds
from worker.sample.seeds import Stage, Streams
from worker.sample.values import rgb, uniform


@dataclass(frozen=True, slots=True)
class Substance:
    """The material of one cable, as if its section were full and round.

    Attributes:
        youngs_modulus_pa: Young's modulus in pascals.
        density_kg_m3: density in kg/m3.
    """

    youngs_modulus_pa: float
    density_kg_m3: float


@dataclass(frozen=True, slots=True)
class _Placement:
    """The start of one cable in the horizontal plane: its middle, mean bearing and natural curvature."""

    x_m: float
    y_m: float
    rotation_deg: float
    bends_per_m: tuple[float, ...]


def sample_substances(ranges: CableRanges, count: int, rng: np.random.Generator) -> list[Substance]:
    """Sample the materials of cables, Young's modulus log-uniformly.

    Args:
        ranges: ranges of the style.
        count: number of cables.
        rng: random generator of the cables.
    """
    low, high = ranges.youngs_modulus_pa
    return [
        Substance(
            youngs_modulus_pa=float(np.clip(np.exp(rng.uniform(np.log(low), np.log(high))), low, high)),
            density_kg_m3=uniform(rng, ranges.density_kg_m3),
        )
        for _ in range(count)
    ]


def sample_cables(
    ranges: Ranges,
    disposition: Disposition,
    substances: list[Substance],
    camera: Camera,
    streams: Streams,
    *,
    length_m: tuple[float, float],
    lowest_m: float,
) -> tuple[Cable, ...]:
    """Sample cables that start one above the other.

    Args:
        ranges: ranges of the style.
        disposition: whether the cables lie freely or along each other.
        substances: material of each cable; their number is that of the cables.
        camera: camera of the picture, whose view limits the cables' thickness.
        streams: function that makes the random generator of a stage of the job.
        length_m: range of the cables' lengths, in metres.
        lowest_m: height of the lowest cable's underside above the floor, in metres.

    Returns:
        The cables, the lowest first.
    """
    placements = _PLACERS[disposition](ranges.placement, len(substances), streams(Stage.PLACEMENT))
    material_rng, look_rng = streams(Stage.CABLE_MATERIAL), streams(Stage.LOOK)
    kinds = sample_kinds(ranges.cable, len(substances), camera, look_rng)
    cables: list[Cable] = []
    start = lowest_m
    for placement, substance, kind in zip(placements, substances, kinds, strict=True):
        published = _sample_material(ranges.cable, material_rng)
        length = uniform(look_rng, length_m)
        course = sample_course(ranges.placement, placement.bends_per_m, length, kind.diameter_m, look_rng)
        cables.append(_cable(placement, substance, kind, published, course, length, start))
        cables[-1] = cables[-1].model_copy(
            update={"ends": sample_ends(ranges.cable.ends, cables[-1].material, kind.diameter_m, look_rng)}
        )
        start += max(ranges.placement.spacing_m, course.rise_m + SPACING_DIAMETERS * kind.diameter_m)
    return tuple(cables)


def _cable(
    placement: _Placement,
    substance: Substance,
    kind: CableKind,
    published: CableMaterial,
    course: Course,
    length_m: float,
    start_m: float,
) -> Cable:
    return Cable(
        diameter_m=kind.diameter_m,
        length_m=length_m,
        x_m=placement.x_m,
        y_m=placement.y_m,
        start_height_m=start_m,
        rotation_deg=placement.rotation_deg,
        bends_per_m=course.bends_per_m,
        rise_m=course.rise_m,
        youngs_modulus_pa=substance.youngs_modulus_pa * kind.stiffness_ratio,
        density_kg_m3=substance.density_kg_m3 * kind.density_ratio,
        material=kind.look or published,
    )


def _place_free(ranges: PlacementRanges, count: int, rng: np.random.Generator) -> list[_Placement]:
    return [
        _Placement(
            x_m=uniform(rng, ranges.free_x_m),
            y_m=uniform(rng, ranges.free_y_m),
            rotation_deg=uniform(rng, ranges.free_rotation_deg),
            bends_per_m=_bends(ranges, rng),
        )
        for _ in range(count)
    ]


def _place_aligned(ranges: PlacementRanges, count: int, rng: np.random.Generator) -> list[_Placement]:
    """Sample one bearing and one natural curvature for all cables; each cable deviates a little from both."""
    bearing = uniform(rng, ranges.aligned_bearing_deg)
    common = np.array(_bends(ranges, rng))
    return [
        _Placement(
            x_m=uniform(rng, ranges.aligned_x_m),
            y_m=uniform(rng, ranges.aligned_y_m),
            rotation_deg=bearing + uniform(rng, ranges.aligned_deviation_deg),
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


def _sample_material(ranges: CableRanges, rng: np.random.Generator) -> CableMaterial:
    offset = ranges.dirt_offset
    return CableMaterial(
        colour=rgb(rng, ranges.colour),
        dirt_colour=rgb(rng, ranges.dirt_colour),
        dirt_position=uniform(rng, ranges.dirt_position),
        dirt_mapping=(uniform(rng, offset), uniform(rng, offset), uniform(rng, offset)),
        dirt_offset=uniform(rng, offset),
        reflection_position=uniform(rng, ranges.reflection_position),
    )
