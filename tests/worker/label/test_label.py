"""Masks and instances, against known silhouettes."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import Delaunay

import worker.label.silhouette
from farm.dataset.instances import list_instances
from farm.scene.cable import Bundle, Cable, Skin, Tie, envelope_ratio
from farm.scene.camera import Camera
from farm.scene.picture_size import PictureSize
from farm.spec.category import Category
from farm.spec.rendering import CableDetail
from tests.worker.scenes import make_scene, make_skin, make_stick, tubular
from worker.cable.piece import OCCLUDER, Convex, Plain, Substance
from worker.cable.tube import sweep
from worker.camera.view import View
from worker.curves import Points
from worker.geometry import SettledGeometry
from worker.label.label import label_cables, label_scene
from worker.simulate.shapes import CableShapes

RADIUS = 0.001
SIDES = 20
VIEW = View(height_m=0.15, resolution=PictureSize.square(256))


def bar(angle_deg: float = 0.0, z: float = RADIUS, shift: float = 0.0, length: float = 0.4) -> Points:
    """A straight cable through the middle of the view."""
    s = np.linspace(-length / 2, length / 2, 401)
    a = np.radians(angle_deg)
    return np.stack([s * np.cos(a) - shift * np.sin(a), s * np.sin(a) + shift * np.cos(a), np.full_like(s, z)], axis=1)


def bundled(strands: int, tie: bool) -> Cable:
    """A cable of 4 mm and 0.2 m, or a bundle of as wide strands as it holds, with a tie."""
    ties = (Tie(along=0.75, width_m=0.003, colour=(20, 20, 20)),) if tie else ()
    look: Skin | Bundle = make_skin()
    if strands:
        look = Bundle(
            strands=tuple(make_skin(pattern_seed=seed) for seed in range(strands)),
            strand_diameter_m=0.004 / envelope_ratio(strands),
            lay_m=0.08,
            phase_deg=20.0,
            ties=ties,
        )
    drawn = make_scene(ranges={"cable": {"count": [1, 1]}}).cables[0]
    return drawn.model_copy(update={"length_m": 0.2, "diameter_m": 0.004, "material": look})


def label(*curves: Points) -> tuple[NDArray[np.uint8], NDArray[np.uint16]]:
    """Mask and instances of cables of one radius."""
    labels = label_cables([tubular(curve, RADIUS, number) for number, curve in enumerate(curves, 1)], VIEW, SIDES)
    return labels.mask, labels.instances


@pytest.mark.parametrize("angle", [10.0, 17.0, 35.0, 80.0])
def test_the_area_of_a_straight_cable_is_its_width_times_its_length(angle: float) -> None:
    """A cylinder of radius r at distance d is f 2 r / sqrt(d^2 - r^2) wide, within 2 % (0.15 px)."""
    mask, _ = label(bar(angle))
    distance = VIEW.height_m - RADIUS
    width = VIEW.resolution.width * 50 / 36 * 2 * RADIUS / np.sqrt(distance**2 - RADIUS**2)
    middle = 128 / max(abs(np.cos(np.radians(angle))), abs(np.sin(np.radians(angle))))
    assert np.count_nonzero(mask) == pytest.approx(width * 2 * middle, rel=0.02)


def test_a_mask_is_0_or_255() -> None:
    """A mask has the published values 0 and 255."""
    mask, _ = label(bar(), bar(60.0, z=3 * RADIUS))
    assert mask.dtype == np.uint8
    assert set(np.unique(mask)) == {0, 255}


def test_instances_fill_the_mask() -> None:
    """A pixel has an instance exactly where the mask is set."""
    mask, instances = label(bar(), bar(60.0, z=3 * RADIUS), bar(30.0, z=5 * RADIUS))
    assert ((instances > 0) == (mask == 255)).all()
    assert set(np.unique(instances)) == {0, 1, 2, 3}


@pytest.mark.parametrize("upper", [1, 2])
def test_the_upper_cable_hides_the_lower(upper: int) -> None:
    """At a crossing in the middle of the picture the upper cable shows."""
    heights = (3 * RADIUS, RADIUS) if upper == 1 else (RADIUS, 3 * RADIUS)
    _, instances = label(bar(z=heights[0]), bar(90.0, z=heights[1]))
    assert (instances[126:130, 126:130] == upper).all()


def test_a_point_above_the_middle_of_the_floor_is_in_the_middle_of_the_picture() -> None:
    """The point is in the picture's middle, and y points up."""
    pixels = VIEW.project(np.array([[0.0, 0.0, 0.0], [0.0, 0.01, 0.0], [0.01, 0.0, 0.0]]))
    assert pixels[0] == pytest.approx([128.0, 128.0])
    assert pixels[1][1] < 128.0
    assert pixels[2][0] > 128.0


def test_an_end_in_the_picture_is_cut_flat() -> None:
    """A cable of 20 mm with both ends in view has a mask 20 mm long, within a pixel."""
    mask, _ = label(bar(length=0.02))
    columns = np.flatnonzero(mask.any(axis=0))
    expected = VIEW.resolution.width * 50 / 36 * 0.02 / (VIEW.height_m - RADIUS)
    assert columns.max() - columns.min() + 1 == pytest.approx(expected, abs=1.0)


def test_what_hides_a_cable_is_background() -> None:
    """An occluder that crosses above cuts the mask in two; one that lies below changes nothing."""
    lower, occluder = tubular(bar(z=RADIUS), RADIUS, 1), tubular(bar(90.0, z=3 * RADIUS), RADIUS, OCCLUDER)
    hidden = label_cables([lower, occluder], VIEW, SIDES)
    assert not hidden.mask[:, 126:130].any()
    assert set(np.unique(hidden.instances)) == {0, 1}
    upper, below = tubular(bar(z=3 * RADIUS), RADIUS, 1), tubular(bar(90.0, z=RADIUS), RADIUS, OCCLUDER)
    assert (label_cables([upper, below], VIEW, SIDES).mask == label_cables([upper], VIEW, SIDES).mask).all()


@pytest.mark.parametrize("tilt", [0.0, 15.0, 30.0])
def test_what_leans_on_the_camera_s_side_of_a_thick_thing_is_before_it(tilt: float) -> None:
    """At the height of a stick's axis, seen from the side, no part of the stick is in front."""
    view = View(0.24, VIEW.resolution, focal_length_mm=24.0, tilt_deg=tilt, tilt_bearing_deg=180.0)
    along = np.linspace(-0.05, 0.05, 51)
    stick, cable = (
        np.stack([np.full_like(along, x), along, np.full_like(along, 0.006)], axis=1) for x in (0.12, 0.113)
    )
    alone = label_cables([tubular(cable, 0.001)], view, SIDES)
    hidden = label_cables([tubular(stick, 0.006, OCCLUDER), tubular(cable, 0.001)], view, SIDES)
    assert alone.mask.any()
    assert (alone.mask == hidden.mask).all()


def test_a_solid_covers_the_hull_of_its_corners() -> None:
    """A box of 20 by 10 mm just above the floor, an occluder on a wide cable, leaves a hole of its size."""
    x, y = np.array([-0.01, 0.01, 0.01, -0.01]), np.array([-0.005, -0.005, 0.005, 0.005])
    rings = np.stack([np.stack([x, y, np.full(4, z)], axis=1) for z in (0.0101, 0.0102)])
    box = Convex(OCCLUDER, rings, np.array([0.0, 0.0, 0.0102]), Plain(Substance.PLASTIC, (0, 0, 0)))
    wide = tubular(bar(z=0.005), 0.01)
    open_px = np.count_nonzero(label_cables([wide], VIEW, SIDES).mask)
    left_px = np.count_nonzero(label_cables([wide, box], VIEW, SIDES).mask)
    expected = 0.02 * 0.01 * (VIEW.resolution.width * 50 / 36 / (VIEW.height_m - 0.0102)) ** 2
    assert open_px - left_px == pytest.approx(expected, rel=0.03)


def test_cables_outside_the_view_leave_nothing() -> None:
    """A cable to the side of the picture leaves nothing."""
    mask, instances = label(bar(shift=0.5))
    assert not mask.any()
    assert not instances.any()


def test_a_picture_without_cables_has_empty_labels() -> None:
    """They are as large as any."""
    mask, instances = label()
    assert mask.shape == instances.shape == (256, 256)
    assert not mask.any()
    assert not instances.any()


def test_a_bundle_s_strands_are_listed_as_the_map_shows_them() -> None:
    """Each number's pixels lie where its cable or strand does, and ties and sticks have no number."""
    left, bundle, right = (bundled(strands, tie) for strands, tie in ((0, False), (3, True), (0, False)))
    scene = make_scene(Category.CLOSE_CONCENTRATED).model_copy(
        update={
            "cables": (left, bundle, right),
            "sticks": (make_stick(),),
            "camera": Camera(height_m=0.15, f_number=8.0),
        }
    )
    heights = (0.002, 0.002, 0.008)
    rows = [bar(z=z, shift=shift, length=0.2) for z, shift in zip(heights, (0.02, 0.0, -0.02), strict=True)]
    across = bar(90.0, z=0.0045, length=0.1)
    shapes = CableShapes(
        nodes_m=tuple(rows),
        radii_m=np.full(3, 0.002),
        lengths_m=np.full(3, 0.2),
        speeds_m_s=tuple(np.zeros(len(row)) for row in rows),
        start_order=(0, 1, 2, 3),
        fall_s=0.0,
        steps=0,
        sticks_m=(across,),
        stick_radii_m=np.array([0.002]),
    )
    geometry = SettledGeometry(scene, shapes, CableDetail(points_per_segment=1), PictureSize.square(256))
    seen = label_scene(geometry).instances
    listed = list_instances(scene, seen)
    numbers, pixels = np.unique(seen[seen > 0], return_counts=True)
    assert [(each.id, each.pixels) for each in listed] == list(zip(numbers.tolist(), pixels.tolist(), strict=True))
    assert [(each.cable, each.strand) for each in listed] == [(0, None), (1, 0), (1, 1), (1, 2), (2, None)]
    places_m = {0: 0.02, 1: 0.0, 2: -0.02}
    for each in listed:
        row = np.flatnonzero((seen == each.id).any(axis=1)).mean()
        middle = VIEW.project(np.array([[0.0, places_m[each.cable], heights[each.cable]]]))[0, 1]
        assert row == pytest.approx(middle, abs=4.0)
    assert not seen[:120, 126:130].any()  # the stick lies across the first cable


@pytest.mark.parametrize(("angle", "shift", "rise"), [(10.0, 0.0, 0.0), (50.0, 0.02, 0.0), (80.0, -0.03, 0.2)])
def test_the_mask_is_the_silhouette_of_the_rendered_tube(angle: float, shift: float, rise: float) -> None:
    """A straight tube with both ends in view is convex, so its silhouette is the hull of its corners."""
    curve = bar(angle, z=0.01, shift=shift, length=0.03)[::20]
    curve[:, 2] += rise * np.linspace(-0.015, 0.015, len(curve))
    mask, _ = label(curve)
    corners = VIEW.project(sweep(curve, RADIUS, SIDES).vertices_m.astype(np.float64))
    middles = np.stack(np.meshgrid(np.arange(256), np.arange(256)), axis=-1) + 0.5
    inside = Delaunay(corners).find_simplex(middles) >= 0
    assert np.count_nonzero(inside != (mask > 0)) <= 4  # at the corners of the ends, less than half is covered


def test_bands_leave_no_trace(monkeypatch: pytest.MonkeyPatch) -> None:
    """A picture that is labelled a few rows at a time is the same."""
    cables = bar(10.0), bar(75.0, z=3 * RADIUS), bar(0.0, z=5 * RADIUS, shift=0.01)
    whole = label(*cables)
    monkeypatch.setattr(worker.label.silhouette, "_BAND_PIXELS", 7 * 256)
    banded = label(*cables)
    assert (whole[0] == banded[0]).all()
    assert (whole[1] == banded[1]).all()


def test_a_cable_that_reaches_the_camera_spoils_nothing() -> None:
    """A steep cable that ends above the camera hides no more than it covers."""
    steep = np.linspace([-0.05, 0.05, RADIUS], [0.0, 0.05, 0.2], 201)
    _, instances = label(bar(), steep)
    assert (instances[126:130] == 1).all()


@pytest.mark.parametrize(("width", "height"), [(256, 192), (192, 256), (256, 64)])
@pytest.mark.parametrize("tilt", [0.0, 25.0])
def test_an_oblong_picture_has_the_middle_of_a_square_ones_labels(width: int, height: int, tilt: float) -> None:
    """With its longer edge as long, it shows the same cables at the same size, pixel for pixel."""
    view = replace(VIEW, tilt_deg=tilt, tilt_bearing_deg=130.0, roll_deg=20.0)
    pieces = [tubular(bar(15.0 + 45.0 * number, 0.001 * number), RADIUS, number) for number in (1, 2, 3)]
    square = label_cables(pieces, view, SIDES)
    oblong = label_cables(pieces, replace(view, resolution=PictureSize(width=width, height=height)), SIDES)
    top, left = (256 - height) // 2, (256 - width) // 2
    assert (oblong.instances == square.instances[top : top + height, left : left + width]).all()
    assert oblong.instances.max() == 3


def test_bands_follow_the_rows_of_a_portrait(monkeypatch: pytest.MonkeyPatch) -> None:
    """A picture that is higher than wide is labelled to its last row, in as many bands as it takes."""
    view = replace(VIEW, resolution=PictureSize(width=64, height=256))
    whole = label_cables([tubular(bar(90.0), RADIUS)], view, SIDES).mask
    monkeypatch.setattr(worker.label.silhouette, "_BAND_PIXELS", 64 * 10)
    assert (label_cables([tubular(bar(90.0), RADIUS)], view, SIDES).mask == whole).all()
    assert (whole[-1] > 0).any()
