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

PILE_SHARE = 0.75
"""Height of a pile over the sum of the diameters in it: 0.74 at most for seven or eight cables, in 360 falls of the
style `published`. A coil may be higher; the worker draws such a scene again if it comes too near to the camera."""

MOST_PILED = 8
"""Most cables that lie across each other in one place, however many there are."""

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
    """

    key: str
    low: float
    high: float
    unit: str
    beyond: str


BOUNDS: tuple[Bound, ...] = ()


def check_workable(spec: DatasetSpec) -> None:
    """Check that pictures can be made of a new description.

    Raises:
        SpecError: if not; the text names the key, its value, the bound and the unit.
    """
    for fault in (*_beyond_bounds(spec), *_camera_faults(spec.ranges)):
        raise SpecError(fault)


def _beyond_bounds(spec: DatasetSpec) -> Iterator[str]:
    for bound in BOUNDS:
        value = attrgetter(bound.key)(spec)
        values = value if isinstance(value, tuple) else (value,)
        yield from (fault for each in values for fault in _fault(bound, bound.key, each))


def _fault(bound: Bound, name: str, value: float) -> Iterator[str]:
    unit = f" {bound.unit}" if bound.unit else ""
    if value < bound.low:
        yield f"{name}: {value:g}{unit} is below {bound.low:g}{unit}: {bound.beyond}"
    if value > bound.high:
        yield f"{name}: {value:g}{unit} is above {bound.high:g}{unit}: {bound.beyond}"


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
    return PILE_SHARE * (min(cable.count[1], MOST_PILED) * thickest + _most_sticks(ranges) * stick)


def _has_bundles(ranges: Ranges) -> bool:
    return ranges.cable.skin.share > 0 and ranges.cable.bundle.share > 0


def _most_sticks(ranges: Ranges) -> int:
    return ranges.clutter.sticks[1] if ranges.clutter.share > 0 else 0
