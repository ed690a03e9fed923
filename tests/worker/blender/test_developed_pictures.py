"""Whole developed pictures: they repeat, their masks are right, and they leave no trace in later pictures."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from assets.surfaces.bake import bake_surfaces  # noqa: E402  # after importorskip
from farm.cli.installed_assets import InstalledAssets  # noqa: E402
from farm.run.worker_settings import DeviceChoice, RendererSettings  # noqa: E402
from farm.scene.camera import Camera, Development  # noqa: E402
from farm.scene.light import GreyWorld, StudioLamp  # noqa: E402
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.category import Category  # noqa: E402
from farm.spec.header import DatasetHeader  # noqa: E402
from farm.spec.job import Job  # noqa: E402
from farm.spec.make_header import Inputs, make_header  # noqa: E402
from farm.spec.parse import parse_spec  # noqa: E402
from worker.blender.renderer import BlenderRenderer, open_renderer  # noqa: E402
from worker.sample.scene import sample_scene  # noqa: E402
from worker.service.picture import Picture  # noqa: E402

pytestmark = pytest.mark.blender

CAMERA = Camera(
    height_m=0.15,
    f_number=6.0,
    focal_length_mm=35.0,
    tilt_deg=20.0,
    tilt_bearing_deg=70.0,
    roll_deg=25.0,
    distortion=-0.1,
)

DEVELOPMENT = Development(
    key=0.2,
    exposure_ev=0.2,
    contrast=1.2,
    saturation=1.1,
    white_balance=(1.1, 0.9),
    vignetting=0.2,
    chromatic_aberration=0.001,
    full_well=3000.0,
    read_noise=3.0,
    sharpening=0.5,
    jpeg_quality=85,
    seed=0,
)

LAMPS = (
    StudioLamp(
        bearing_deg=0.0, elevation_deg=40.0, distance_m=1.0, irradiance_w_m2=2.0, size_m=0.05, temperature_k=3000.0
    ),
    StudioLamp(
        bearing_deg=150.0, elevation_deg=70.0, distance_m=2.0, irradiance_w_m2=1.0, size_m=0.8, temperature_k=6500.0
    ),
)


@pytest.fixture(scope="module")
def header() -> DatasetHeader:
    """A header of draft pictures of 128 pixels over one surface."""
    spec = parse_spec(
        {"seed": 0, "style": "published", "images": 600, "resolution": 128, "quality": "draft"}, source="test"
    )
    made = make_header(spec, Inputs(environments=False), InstalledAssets())
    return made.model_copy(update={"surfaces": tuple(s for s in made.surfaces if s.name == "concrete_smooth")})


@pytest.fixture
def renderer(header: DatasetHeader, tmp_path: Path) -> BlenderRenderer:
    """A renderer with a fresh template."""
    bake_surfaces(tmp_path, pixels=256, names=("concrete_smooth",), processes=1)
    return open_renderer(header, RendererSettings(device=DeviceChoice.CPU, assets=tmp_path))


@contextmanager
def photographed(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Sample scenes with the camera and development above, and under lamps with the lamps above."""

    def draw(header: DatasetHeader, job: Job, attempt: int) -> Scene:
        scene = sample_scene(header, job, attempt)
        update: dict[str, object] = {"camera": CAMERA, "development": DEVELOPMENT}
        if scene.lamps:
            update |= {"lamps": LAMPS, "grey_world": GreyWorld(radiance=0.3, temperature_k=5000.0)}
        return scene.model_copy(update=update)

    with monkeypatch.context() as patch:
        patch.setattr("worker.blender.renderer.sample_scene", draw)
        yield


def same(one: Picture, other: Picture) -> bool:
    """Picture and labels, to the byte."""
    return all(one.files[role].tobytes() == other.files[role].tobytes() for role in ("image", "instances"))


@pytest.mark.parametrize("category", [Category.CLOSE_CONCENTRATED, Category.FAR])
def test_a_photograph_leaves_nothing_behind(
    renderer: BlenderRenderer, header: DatasetHeader, monkeypatch: pytest.MonkeyPatch, category: Category
) -> None:
    """A published picture is the same before and after a developed one, and so is the developed one a second time."""
    job = Job(category=category, index=1)
    before = renderer.make(job, header)
    with photographed(monkeypatch):
        first = renderer.make(job, header)
    after = renderer.make(job, header)
    with photographed(monkeypatch):
        again = renderer.make(job, header)
    assert same(before, after)
    assert same(first, again)
    assert not same(before, first)


@pytest.mark.parametrize("category", [Category.CLOSE_CONCENTRATED, Category.FAR])
def test_a_photograph_is_lit_and_masked(
    renderer: BlenderRenderer, header: DatasetHeader, monkeypatch: pytest.MonkeyPatch, category: Category
) -> None:
    """The picture is neither black nor white, and its gradients lie on the mask's edges."""
    with photographed(monkeypatch):
        made = renderer.make(Job(category=category, index=1), header)
    assert 40 < made.files["image"].mean() < 200
    grey = made.files["image"].astype(float).mean(axis=2)
    slope = np.hypot(*np.gradient(grey))
    inside = made.files["mask"] == 255
    edge = np.hypot(*np.gradient(inside.astype(float))) > 0
    assert slope[edge].mean() > 2 * slope[~edge].mean()
