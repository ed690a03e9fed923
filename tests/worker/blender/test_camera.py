"""Blender's camera agrees with the masks, for any direction and lens."""

import numpy as np
import pytest
from numpy.typing import NDArray

bpy = pytest.importorskip("bpy")

from benchmarks.masks.agreement import compare  # noqa: E402
from benchmarks.masks.reference import render_coverage  # noqa: E402
from farm.dataset.outputs import INSTANCES  # noqa: E402
from farm.run.worker_settings import DeviceChoice, RendererSettings  # noqa: E402
from farm.scene.camera import Camera  # noqa: E402
from farm.scene.picture_size import PictureSize  # noqa: E402
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.category import Category  # noqa: E402
from farm.spec.make_header import template_ref  # noqa: E402
from farm.spec.rendering import CableDetail, CyclesSettings, Denoiser, PictureSettings  # noqa: E402
from tests.worker.scenes import make_header, make_scene  # noqa: E402
from worker.backdrop.matte import covered_by  # noqa: E402
from worker.blender.renderer import BlenderRenderer, open_renderer  # noqa: E402
from worker.geometry import SettledGeometry  # noqa: E402
from worker.simulate.shapes import CableShapes  # noqa: E402
from worker.simulate.simulate import simulate  # noqa: E402

pytestmark = pytest.mark.blender

RESOLUTION = PictureSize.square(256)

SHAPES = {"landscape": PictureSize(width=256, height=144), "portrait": PictureSize(width=96, height=256)}

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


@pytest.fixture
def renderer() -> BlenderRenderer:
    """One with a fresh template and no assets."""
    header = make_header().model_copy(update={"template": template_ref(None)})
    return open_renderer(header, RendererSettings(device=DeviceChoice.CPU))


def seen_by(
    camera: Camera, settled: tuple[Scene, CableShapes], resolution: PictureSize = RESOLUTION
) -> SettledGeometry:
    """The cables without a floor, before another camera."""
    scene, shapes = settled
    return SettledGeometry(
        scene.model_copy(update={"camera": camera, "floor": None}), shapes, CableDetail(), resolution
    )


def render_white(renderer: BlenderRenderer, geometry: SettledGeometry) -> NDArray[np.float64]:
    """Coverage by the scene's cables as Cycles finds it."""
    settings = PictureSettings(cycles=CyclesSettings(samples=64, denoiser=Denoiser.NONE))
    renderer.build(geometry, settings.economy)
    renderer.use_cycles(settings, geometry.resolution, seed=0)
    return render_coverage(geometry.scene.camera, samples=128)


@pytest.mark.parametrize(
    ("name", "resolution"),
    [*((name, RESOLUTION) for name in CAMERAS), ("wide", SHAPES["landscape"]), ("wide", SHAPES["portrait"])],
    ids=str,
)
def test_a_mask_agrees_with_a_render_through_any_lens(
    renderer: BlenderRenderer, settled: tuple[Scene, CableShapes], name: str, resolution: PictureSize
) -> None:
    """White cables on black, tilted, rolled, distorted: edges within a fifth of a pixel, area within a hundredth."""
    geometry = seen_by(CAMERAS[name], settled, resolution)
    coverage = render_white(renderer, geometry)
    agreement = compare(renderer.label(geometry)[INSTANCES.role], coverage)
    assert coverage.shape == resolution.shape
    assert agreement.iou > 0.97
    assert agreement.edge_error_px <= 0.2
    assert agreement.gap_pixels < 20
    assert agreement.area_ratio == pytest.approx(1.0, abs=0.01)


def test_what_is_out_of_focus_covers_as_it_does_in_a_render(
    renderer: BlenderRenderer, settled: tuple[Scene, CableShapes]
) -> None:
    """A wide open lens, tilted and in focus above the floor: its coverage is Cycles' within a few samples' noise."""
    camera = CAMERAS["long"].model_copy(update={"f_number": 4.0, "focus_offset_m": 0.02, "distortion": 0.0})
    geometry = seen_by(camera, settled)
    coverage = render_white(renderer, geometry)
    pieces, view, sides = geometry.pieces, geometry.view, geometry.detail.sides
    found = covered_by(pieces, view, geometry.lens_radius_m, sides)
    sharp = covered_by(pieces, view, 0.0, sides)
    error = np.abs(found - coverage).mean()
    assert error < 0.01
    assert error < 0.25 * np.abs(sharp - coverage).mean()
