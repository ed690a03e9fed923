"""What a new description may ask for, beyond the types of its keys: the values with which pictures were made.

A dataset that is there is read without these bounds, whatever release described it: its pictures are made.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from operator import attrgetter

from farm.errors import SpecError
from farm.scene.cable import envelope_ratio
from farm.scene.camera import FOCAL_LENGTH_MM, NEAR_CLIP_M, SENSOR_MM
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.ranges.all import Ranges, seen_width_m
from farm.spec.ranges.camera import CameraRanges
from farm.spec.simulation import Simulator

PILE_SHARE = 0.75
"""Height of a pile over the sum of the diameters in it: 0.74 at most for seven or eight cables, in 360 falls of the
style `published`. A coil may be higher; the worker draws such a scene again if it comes too near to the camera."""

MOST_PILED = 8
"""Most cables and sticks that lie across each other in one place, however many there are."""

THICKEST_STICK_SHARE = 0.1
"""Largest diameter of a stick, as a share of the picture's width: no thicker one is drawn."""


@dataclass(frozen=True, slots=True)
class Bound:
    """The smallest and the largest value of a key that was measured to work.

    Attributes:
        key: key of the description, with dots between tables.
        low: smallest value.
        high: largest value.
        unit: unit of both; empty for a plain number.
        beyond: what happens beyond them, for the error's text.
        only: the simulator with which the bound holds; None for every one.
    """

    key: str
    low: float
    high: float
    unit: str
    beyond: str
    only: Simulator | None = None


_FINE = "a graphics card's numbers of 32 bits are too coarse there"
_TURNS = "ten turns to either side are enough"

BOUNDS: tuple[Bound, ...] = (
    # With six radii each of four falls of `wide` rested; with eight, a coil cut into itself by 0.14 of its radius, with
    # ten by 0.44, and it did not rest within 4 s.
    Bound("fall.rod.segment_radii", 1, 6, "radii", "longer segments let coils cut into themselves, and never rest"),
    # Cables that start 4 mm above the floor land after 0.029 s.
    Bound("fall.rod.max_time_s", 0.03, 60, "s", "no cable lands so soon"),
    # Three falls of `published` at 40 rested after 1,213 steps at most, and at 100 after 8,634; of three at 200 one
    # rested within 16,000 steps, and of three at 400 none: the wind carries the cables faster than the solver follows.
    Bound("ranges.wind.strength", 0, 100, "", "no cable comes to rest in such a wind"),
    # Two short cables of cloth rested at 40, and not at 50: this wind does not die down.
    Bound("ranges.wind.strength", 0, 40, "", "no cable of cloth comes to rest in such a wind", Simulator.CLOTH),
    # At strength 10 cloth rested after 37 frames with 10, after 231 with 100, and fell through the floor with 1e5.
    Bound("ranges.wind.flow_per_strength", 0, 10, "", "cables of cloth fly through the floor", Simulator.CLOTH),
    # A gust that is shorter than two time steps of 1 ms is not seen; one of 1e-309 s has no frequency.
    Bound("ranges.wind.gust_period_s", 0.002, 1e5, "s", "it is shorter than the solver's steps"),
    # Cloth rested at 0.1, and not at 0.03, within 250 frames.
    Bound("ranges.cable.vertex_mass", 0.1, 1e5, "", "no cable of cloth so light comes to rest", Simulator.CLOTH),
    # Cloth rested at 3e9, and not at 1e10.
    Bound(
        "ranges.cable.youngs_modulus_pa", 1e5, 3e9, "Pa", "no cable of cloth so stiff comes to rest", Simulator.CLOTH
    ),
    # A step of a 32-bit number is 0.001 at 10,000: a texel of a texture of 1,000 texels.
    *(
        Bound(key, -1e4, 1e4, "", _FINE)
        for key in ("ranges.floor.offset_x", "ranges.floor.offset_y", "ranges.cable.dirt_offset")
    ),
    *(
        Bound(key, -3600, 3600, "degrees", _TURNS)
        for key in (
            "ranges.floor.rotation_deg",
            "ranges.wind.bearing_deg",
            "ranges.wind.tilt_deg",
            "ranges.placement.free_rotation_deg",
            "ranges.placement.aligned_bearing_deg",
            "ranges.placement.aligned_deviation_deg",
            "ranges.camera.roll_deg",
            "ranges.lamp.point_bearing_deg",
            "ranges.world.rotation_deg",
            "ranges.world.close_tilts_deg",
        )
    ),
    # A lamp at 0.1 m is as near as the camera; cables reach 0.4 m to either side. A disc of ten distances is the sky.
    Bound("ranges.studio.distance_m", 0.1, 1000, "m", "a lamp stands beside the cables, not among them"),
    Bound("ranges.studio.size_share", 1e-4, 10, "", "a lamp is neither a point nor the whole sky"),
)

MOST_WIND_M_S = 25.0
"""Fastest mean wind, in m/s, in which rods came to rest: a storm; see `ranges.wind.strength`."""

MOST_STEPS = 400_000
"""Most time steps that a fall may plan: 100 times the default's. At 100,000 a second, the largest number, a fall of
`wide` rested after 69,370 steps, which took 12 s; one that never rests takes a core 70 s, and at most four times as
much."""

CLEAR_OF_LAMPS_M = 1.5
"""Least distance of a published lamp's surface from the middle of the cables, in metres: the longest cable may end a
metre away, and starts up to half a metre aside."""


def check_workable(spec: DatasetSpec) -> None:
    """Check that pictures can be made of a new description.

    Raises:
        SpecError: if not; the text names the key, its value, the bound and the unit.
    """
    for faults in (_beyond_bounds(spec), _fall_faults(spec), _lamp_faults(spec), _camera_faults(spec.ranges)):
        for fault in faults:
            raise SpecError(fault)


def _beyond_bounds(spec: DatasetSpec) -> Iterator[str]:
    for bound in BOUNDS:
        value = attrgetter(bound.key)(spec)
        if bound.only not in {None, spec.simulator}:
            continue
        values = value if isinstance(value, tuple) else (value,)
        yield from (fault for each in values for fault in _fault(bound, bound.key, each))


def _fault(bound: Bound, name: str, value: float) -> Iterator[str]:
    unit = f" {bound.unit}" if bound.unit else ""
    if value < bound.low:
        yield f"{name}: {value:g}{unit} is below {bound.low:g}{unit}: {bound.beyond}"
    if value > bound.high:
        yield f"{name}: {value:g}{unit} is above {bound.high:g}{unit}: {bound.beyond}"


def _fall_faults(spec: DatasetSpec) -> Iterator[str]:
    rod, wind = spec.fall.rod, spec.ranges.wind
    if spec.simulator is not Simulator.ROD:
        return
    steps = rod.steps_per_s * rod.max_time_s
    if steps > MOST_STEPS:
        yield (
            f"fall.rod.steps_per_s {rod.steps_per_s} and max_time_s {rod.max_time_s:g} s make {steps:,.0f} time steps, "
            f"more than {MOST_STEPS:,}: such a fall takes minutes; lower either"
        )
    fastest_m_s = wind.strength[1] * wind.speed_per_strength_m_s
    if fastest_m_s > MOST_WIND_M_S:
        yield (
            f"ranges.wind.strength {wind.strength[1]:g} times speed_per_strength_m_s {wind.speed_per_strength_m_s:g} "
            f"is a wind of {fastest_m_s:g} m/s, above {MOST_WIND_M_S:g} m/s: no cable comes to rest in it; lower either"
        )


def _lamp_faults(spec: DatasetSpec) -> Iterator[str]:
    lamp = spec.ranges.lamp
    nearest_m = math.hypot(lamp.point_radius_m[0], lamp.point_height_m[0]) - lamp.point_size_m[1]
    if lamp.area_share < 1 and nearest_m < CLEAR_OF_LAMPS_M:
        yield (
            f"ranges.lamp.point_size_m {lamp.point_size_m[1]:g} m reaches to {nearest_m:.2g} m from the cables, below "
            f"{CLEAR_OF_LAMPS_M:g} m: cables would lie in the lamp; lower it, or raise point_radius_m or point_height_m"
        )


def _camera_faults(ranges: Ranges) -> Iterator[str]:
    camera = ranges.camera
    for height_m in camera.heights_m:
        pile_m = highest_pile_m(ranges, seen_width_m(height_m))
        for focal_length_mm in camera.focal_lengths_mm:
            clear_m = clear_height_m(camera, height_m, focal_length_mm)
            if clear_m < pile_m:
                yield (
                    f"ranges.camera.heights_m {height_m:g} with focal_lengths_mm {focal_length_mm:g} and tilt_deg "
                    f"{camera.tilt_deg[1]:g}: the camera sees nothing above {max(clear_m, 0.0):.3g} m, and the highest "
                    f"pile of cable.count, cable.diameter_m{_piled_beside(ranges)} is {pile_m:.3g} m: raise heights_m, "
                    "or leave out short focal_lengths_mm"
                )


def _piled_beside(ranges: Ranges) -> str:
    beside = ", cable.bundle" if _has_bundles(ranges) else ""
    return beside + (", clutter.sticks" if _most_sticks(ranges) else "")


def clear_height_m(camera: CameraRanges, height_m: float, focal_length_mm: float) -> float:
    """Compute the height above the floor, in metres, above which a thing may be too near for a camera to see it.

    Args:
        camera: ranges of the tilt and of the aperture.
        height_m: height of a 50 mm lens, in metres.
        focal_length_mm: the lens's focal length, in millimetres, which sets the distance at which it stands.
    """
    distance_m = height_m * focal_length_mm / FOCAL_LENGTH_MM
    corner = math.sqrt(0.5) * SENSOR_MM / focal_length_mm
    lens_radius_m = 0.5e-3 * focal_length_mm / camera.f_number[0]
    return min(
        (distance_m - NEAR_CLIP_M) * math.cos(tilt) - (NEAR_CLIP_M * corner + lens_radius_m) * math.sin(tilt)
        for tilt in map(math.radians, camera.tilt_deg)
    )


def highest_pile_m(ranges: Ranges, seen_m: float) -> float:
    """Compute the height, in metres, of the highest pile in a picture whose width on the floor is `seen_m` metres."""
    cable = ranges.cable
    thickest = cable.diameters_m(seen_m)[1]
    if _has_bundles(ranges):
        ratio = envelope_ratio(cable.bundle.strands[1])
        strand = max(cable.bundle.strand_diameter_m[1], cable.narrowest_share * seen_m)
        thickest = max(thickest, min(ratio * strand, 1.5 * cable.widest_share * seen_m))
    stick = min(ranges.clutter.stick_diameter_m[1], THICKEST_STICK_SHARE * seen_m)
    diameters = sorted([thickest] * cable.count[1] + [stick] * _most_sticks(ranges), reverse=True)
    return PILE_SHARE * sum(diameters[:MOST_PILED])


def _has_bundles(ranges: Ranges) -> bool:
    return ranges.cable.skin.share > 0 and ranges.cable.bundle.share > 0


def _most_sticks(ranges: Ranges) -> int:
    return ranges.clutter.sticks[1] if ranges.clutter.share > 0 else 0
