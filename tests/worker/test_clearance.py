"""Room for the camera and the lamps above settled cables. No simulator runs."""

from dataclasses import replace

import numpy as np
import pytest

from farm.scene.camera import NEAR_CLIP_M, Camera
from farm.scene.clutter import Part, PartKind, Peg, StickKind
from farm.scene.light import AreaLamp, Lamp, PointLamp, StudioLamp
from farm.scene.picture_size import PictureSize
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.rendering import CableDetail
from tests.worker.scenes import make_scene, make_stick
from tests.worker.settled import RADIUS, rod, shapes
from worker.camera.view import View
from worker.clearance import distances_m, find_room_fault, settled_top_m
from worker.geometry import SettledGeometry
from worker.simulate.shapes import CableShapes

ONE = {"cable": {"count": [1, 1], "diameter_m": 2 * RADIUS}}
SCENE = make_scene(Category.CLOSE_CONCENTRATED, ranges=ONE)
STICK = make_stick(StickKind.PIPE, diameter_m=0.02, length_m=0.2)
PART = Part(kind=PartKind.CONNECTOR, x_m=0.0, y_m=0.05, rotation_deg=0.0, size_m=0.02, colour=(9, 9, 9), pattern_seed=0)
SIZE = PictureSize.square(96)
WIDE_LENS = Camera(height_m=0.018, f_number=8.0, focal_length_mm=10.0)


def settled(scene: Scene, fallen: CableShapes) -> SettledGeometry:
    """A scene after its fall."""
    return SettledGeometry(scene, fallen, CableDetail(), SIZE)


def seen_from(camera: Camera, top_m: float, **more: object) -> str | None:
    """The fault of a cable whose upper side is `top_m` high; `more` are fields of the scene."""
    scene = SCENE.model_copy(update={"camera": camera, "lamps": (), **more})
    return find_room_fault(settled(scene, shapes(rod(z=top_m - RADIUS))))


def test_cables_as_high_as_a_short_lens_are_refused() -> None:
    """A 10 mm lens stands at a fifth of the height that a 50 mm lens has; the text gives both heights and the lens."""
    assert seen_from(WIDE_LENS, 0.029) == (
        "cables or clutter are 29.0 mm high, above the 11.7 mm that a camera sees from 18 mm with a lens of 10 mm"
    )
    assert seen_from(Camera(height_m=0.09, f_number=8.0), 0.029) is None


@pytest.mark.parametrize(("top_m", "is_clear"), [(0.0116, True), (0.0118, False), (0.0129, False)])
def test_cables_keep_a_margin_from_where_the_view_begins(top_m: float, is_clear: bool) -> None:
    """The view begins 5 mm before the camera, at 13 mm; a tenth of that stays free."""
    assert (seen_from(WIDE_LENS, top_m) is None) is is_clear


@pytest.mark.parametrize("tilt_deg", [0.0, 10.0, 20.0, 30.0])
@pytest.mark.parametrize("bearing_deg", [0.0, 77.0])
def test_nothing_below_the_opening_is_cut_off(tilt_deg: float, bearing_deg: float) -> None:
    """For every tilt, each point below the opening's height that the picture shows lies beyond the near plane."""
    view = View(
        height_m=0.05,
        resolution=SIZE,
        focal_length_mm=14.0,
        tilt_deg=tilt_deg,
        tilt_bearing_deg=bearing_deg,
        roll_deg=9,
    )
    opening_m = view.lowest_opening_m(NEAR_CLIP_M, 0.0)
    across = np.linspace(-0.2, 0.2, 401)
    level = np.stack([*(axis.ravel() for axis in np.meshgrid(across, across)), np.full(401**2, opening_m - 1e-6)], 1)
    before = level[view.depths_m(level) > 0]
    seen_px = view.project(before)
    shown = before[((seen_px >= 0) & (seen_px <= SIZE.width)).all(axis=1)]
    assert len(shown) > 10
    assert view.depths_m(shown).min() > NEAR_CLIP_M


def test_a_wide_aperture_lowers_the_opening_of_a_tilted_camera() -> None:
    """A lens of 10 mm radius that is tilted by 30 degrees reaches 5 mm farther down."""
    view = View(height_m=0.1, resolution=SIZE, tilt_deg=30.0)
    assert view.lowest_opening_m(0.005, 0.0) - view.lowest_opening_m(0.005, 0.01) == pytest.approx(0.005)


def test_sticks_pegs_and_parts_count_as_cables_do() -> None:
    """The highest place is that of whatever lies highest."""
    fallen = shapes(rod())
    assert settled_top_m(settled(SCENE, fallen)) == pytest.approx(2 * RADIUS, rel=0.02)
    with_stick = CableShapes(
        **{
            **{name: getattr(fallen, name) for name in fallen.__dataclass_fields__},
            "sticks_m": (rod(z=0.01),),
            "stick_radii_m": np.array([0.01]),
        }
    )
    assert settled_top_m(settled(SCENE.model_copy(update={"sticks": (STICK,)}), with_stick)) == pytest.approx(0.02)
    peg = Peg(x_m=0.0, y_m=0.0, diameter_m=0.01, height_m=0.03, colour=(9, 9, 9), pattern_seed=0)
    with_peg = replace(fallen, pegs_m=(np.array([[0, 0, -0.005], [0, 0, 0.03]]),), peg_radii_m=np.array([0.005]))
    assert settled_top_m(settled(SCENE.model_copy(update={"pegs": (peg,)}), with_peg)) == pytest.approx(0.03)
    with_part = settled(SCENE.model_copy(update={"parts": (PART,)}), fallen)
    assert settled_top_m(with_part) > 4 * RADIUS


LAMPS: list[tuple[Lamp, bool]] = [
    (PointLamp(bearing_deg=0, radius_m=5, height_m=5, power_w=9, size_m=2), True),
    (PointLamp(bearing_deg=0, radius_m=5, height_m=5, power_w=9, size_m=8), False),
    (PointLamp(bearing_deg=0, radius_m=0.05, height_m=0.001, power_w=9, size_m=0.001), False),
    (AreaLamp(x_m=4, power_w=9), True),
    (
        StudioLamp(bearing_deg=0, elevation_deg=25, distance_m=0.5, irradiance_w_m2=1, size_m=0.3, temperature_k=5e3),
        True,
    ),
    (
        StudioLamp(bearing_deg=90, elevation_deg=45, distance_m=0.001, irradiance_w_m2=1, size_m=1, temperature_k=5e3),
        False,
    ),
    (
        StudioLamp(bearing_deg=90, elevation_deg=90, distance_m=0.02, irradiance_w_m2=1, size_m=1, temperature_k=5e3),
        True,
    ),
]


@pytest.mark.parametrize(("lamp", "is_clear"), LAMPS)
def test_a_lamp_in_a_cable_is_refused(lamp: Lamp, is_clear: bool) -> None:
    """Spheres are solid; discs are flat, and face the cables."""
    fault = seen_from(Camera(height_m=0.2, f_number=8.0), 2 * RADIUS, lamps=(lamp,))
    assert fault == (None if is_clear else f"a cable lies in a {lamp.kind} lamp")


def test_the_distance_from_a_disc_is_that_of_its_nearest_point() -> None:
    """Above the disc it is the height, and beside it the distance from the rim."""
    disc = StudioLamp(
        bearing_deg=0, elevation_deg=90, distance_m=1.0, irradiance_w_m2=1, size_m=0.2, temperature_k=5000
    )
    points = np.array([[0.0, 0.0, 0.7], [0.5, 0.0, 1.0], [0.4, 0.0, 0.6]])
    assert distances_m(disc, points) == pytest.approx([0.3, 0.4, 0.5])
