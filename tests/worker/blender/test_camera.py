"""Blender's camera agrees with the masks, for any direction and lens."""

import numpy as np
import pytest
from numpy.typing import NDArray

bpy = pytest.importorskip("bpy")

from benchmarks.masks.agreement import compare  # noqa: E402
from benchmarks.masks.reference import render_coverage  # noqa: E402
from blend.build import TEMPLATE  # noqa: E402  # after importorskip
from blend.contract import open_template  # noqa: E402
from farm.scene.camera import Camera  # noqa: E402
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.category import Category  # noqa: E402
from farm.spec.rendering import CableDetail, CyclesSettings, Denoiser, Economy, PictureSettings  # noqa: E402
from tests.worker.scenes import make_header, make_scene  # noqa: E402
from worker.backdrop.matte import covered_by  # noqa: E402
from worker.backdrop.panorama import lens_radius_m  # noqa: E402
from worker.blender.asset_files import AssetLibrary  # noqa: E402
from worker.blender.build_scene import build_scene  # noqa: E402
from worker.blender.image_cache import ImageCache  # noqa: E402
from worker.blender.render import configure_cycles, configure_picture  # noqa: E402
from worker.cable.pieces import pieces_of  # noqa: E402
from worker.camera.view import View  # noqa: E402
from worker.curves import smooth  # noqa: E402
from worker.label.label import label_scene  # noqa: E402
from worker.simulate.shapes import CableShapes  # noqa: E402
from worker.simulate.simulate import simulate  # noqa: E402

pytestmark = pytest.mark.blender

RESOLUTION = 256

CAMERAS = {
    "wide": Camera(
        height_m=0.11,
        f_number=16.0,
        focal_length_mm=28.0,
        tilt_deg=25.0,
        tilt_bearing_deg=200.0,
        roll_deg=77.0,
        distortion=-0.15,
    ),
    "long": Camera(
        height_m=0.4,
        f_number=8.0,
        focal_length_mm=100.0,
        tilt_deg=12.0,
        tilt_bearing_deg=40.0,
        roll_deg=-30.0,
        focus_offset_m=0.01,
        distortion=0.1,
    ),
}


@pytest.fixture(scope="module")
def settled() -> tuple[Scene, CableShapes]:
    """A far scene with its cables at rest."""
    thin = {"cable": {"count_draws": 1, "diameter_m": 0.002}}
    scene, header = make_scene(Category.CLOSE_CONCENTRATED, index=3, ranges=thin), make_header()
    return scene, simulate(scene, header.spec.simulator, header.spec.fall)


@pytest.fixture(autouse=True)
def template() -> None:
    """A fresh template."""
    open_template(TEMPLATE)


def render_white(scene: Scene, shapes: CableShapes) -> NDArray[np.float64]:
    """The coverage by the scene's cables as Cycles finds it."""
    settings = PictureSettings(cycles=CyclesSettings(samples=64, denoiser=Denoiser.NONE))
    build_scene(
        scene,
        shapes,
        AssetLibrary(make_header(), None),
        ImageCache(),
        traits=Category.CLOSE_CONCENTRATED.traits,
        resolution=RESOLUTION,
        detail=CableDetail(),
        economy=Economy(),
    )
    configure_cycles(configure_picture(RESOLUTION, 0), settings, "cpu", 0)
    return render_coverage(scene.camera, samples=128)


@pytest.mark.parametrize("name", CAMERAS)
def test_a_mask_agrees_with_a_render_through_any_lens(settled: tuple[Scene, CableShapes], name: str) -> None:
    """Tilted, rolled and distorted: edges agree within a fifth of a pixel, areas within a hundredth."""
    drawn, shapes = settled
    scene = drawn.model_copy(update={"camera": CAMERAS[name], "floor": None})
    coverage = render_white(scene, shapes)
    agreement = compare(label_scene(scene, shapes, CableDetail(), RESOLUTION).instances, coverage)
    assert agreement.iou > 0.97
    assert agreement.edge_error_px <= 0.2
    assert agreement.gap_pixels < 20
    assert agreement.area_ratio == pytest.approx(1.0, abs=0.01)


def test_what_is_out_of_focus_covers_as_it_does_in_a_render(settled: tuple[Scene, CableShapes]) -> None:
    """With a wide open lens, tilted and in focus above the floor, coverage is Cycles' within a few samples' noise."""
    drawn, shapes = settled
    camera = CAMERAS["long"].model_copy(update={"f_number": 4.0, "focus_offset_m": 0.02, "distortion": 0.0})
    scene = drawn.model_copy(update={"camera": camera, "floor": None})
    coverage = render_white(scene, shapes)
    curves = [smooth(nodes, CableDetail().points_per_segment) for nodes in shapes.nodes_m]
    view = View.of(camera, RESOLUTION)
    pieces = pieces_of(scene, curves, shapes.sticks_m)
    found = covered_by(pieces, view, lens_radius_m(camera), CableDetail().sides)
    sharp = covered_by(pieces, view, 0.0, CableDetail().sides)
    error = np.abs(found - coverage).mean()
    assert error < 0.01
    assert error < 0.25 * np.abs(sharp - coverage).mean()
