"""Cables in a real picture: the labels agree with the render, and nothing stays."""

from pathlib import Path

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from assets.surfaces.bake import bake_surfaces  # noqa: E402  # after importorskip
from benchmarks.masks.agreement import compare  # noqa: E402
from benchmarks.masks.reference import render_coverage  # noqa: E402
from blend import names  # noqa: E402
from farm.cli.installed_assets import InstalledAssets  # noqa: E402
from farm.run.worker_settings import DeviceChoice, RendererSettings  # noqa: E402
from farm.scene.cable import (  # noqa: E402
    Bundle,
    Cable,
    CableEnd,
    EndKind,
    Sheath,
    Tie,
    envelope_ratio,
)
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.category import Category  # noqa: E402
from farm.spec.header import DatasetHeader  # noqa: E402
from farm.spec.job import Job  # noqa: E402
from farm.spec.make_header import Inputs, make_header  # noqa: E402
from farm.spec.parse import parse_spec  # noqa: E402
from tests.worker.scenes import make_skin  # noqa: E402
from worker.blender.renderer import BlenderRenderer, open_renderer  # noqa: E402
from worker.sample.scene import sample_scene  # noqa: E402

pytestmark = pytest.mark.blender

SURFACES = ("concrete_smooth",)
RESOLUTION = 384


@pytest.fixture(scope="module")
def header() -> DatasetHeader:
    """A header of draft pictures over one surface."""
    keys = {"seed": 0, "style": "published", "images": 600, "resolution": RESOLUTION, "quality": "draft"}
    made = make_header(parse_spec(keys, source="test"), Inputs(environments=False), InstalledAssets())
    return made.model_copy(update={"surfaces": tuple(s for s in made.surfaces if s.name in SURFACES)})


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The baked surface, small."""
    folder = tmp_path_factory.mktemp("surfaces")
    bake_surfaces(folder, pixels=256, names=SURFACES, processes=1)
    return folder


def dressed(cables: tuple[Cable, ...], index: int) -> tuple[Cable, ...]:
    """A bundle with ties, a short cable with a ferrule and a stripped end, and a braided one."""
    strands = 3 + 2 * index
    bundle = Bundle(
        strands=tuple(make_skin(pattern_seed=seed) for seed in range(strands)),
        strand_diameter_m=0.0018,
        lay_m=0.1,
        phase_deg=30.0,
        ties=(Tie(along=0.45, width_m=0.004, colour=(20, 20, 20)), Tie(along=0.55, width_m=0.003, colour=(220, 0, 0))),
    )
    ends = (
        CableEnd(kind=EndKind.FERRULE, bare_m=0.012, collar=(20, 60, 180)),
        CableEnd(kind=EndKind.STRIPPED, bare_m=0.01),
    )
    drawn = cables * 3
    short = {"length_m": 0.07, "diameter_m": 0.004, "ends": ends, "material": make_skin(roughness=0.2)}
    return (
        drawn[0].model_copy(update={"diameter_m": 0.0018 * envelope_ratio(strands), "material": bundle}),
        drawn[1].model_copy(update={**short, "x_m": 0.01, "y_m": 0.015, "start_height_m": 0.02}),
        drawn[2].model_copy(update={"start_height_m": 0.03, "material": make_skin(sheath=Sheath.BRAIDED)}),
    )


@pytest.fixture
def renderer(header: DatasetHeader, baked: Path, monkeypatch: pytest.MonkeyPatch) -> BlenderRenderer:
    """A renderer that replaces the sampled cables by the dressed ones."""

    def draw(header: DatasetHeader, job: Job, attempt: int) -> Scene:
        scene = sample_scene(header, job, attempt)
        camera = scene.camera.model_copy(update={"height_m": 0.18})
        return scene.model_copy(update={"cables": dressed(scene.cables, job.index % 2), "camera": camera})

    monkeypatch.setattr("worker.blender.renderer.sample_scene", draw)
    return open_renderer(header, RendererSettings(device=DeviceChoice.CPU, assets=baked))


@pytest.mark.parametrize("index", [0, 1])
def test_the_mask_of_bundles_ties_and_ends_is_that_of_a_render(
    renderer: BlenderRenderer, header: DatasetHeader, index: int
) -> None:
    """Against white cables and black ties at 64 samples, almost all differing pixels are about half covered."""
    made = renderer.make(Job(category=Category.CLOSE_CONCENTRATED, index=index), header)
    assert made.files["instances"].max() == 3 + 2 * index + 2
    rendered = render_coverage(made.scene.camera, samples=64)
    assert compare(made.files["instances"], rendered).iou > 0.985
    differs = (made.files["mask"] > 0) != (rendered >= 0.5)
    assert np.count_nonzero(differs & (np.abs(rendered - 0.5) > 0.2)) <= 3


def test_a_backdrop_takes_ties_for_what_covers(renderer: BlenderRenderer, header: DatasetHeader) -> None:
    """In a far picture the ties' pixels are neither black nor transparent."""
    made = renderer.make(Job(category=Category.FAR, index=1), header)
    assert made.files["image"].shape == (RESOLUTION, RESOLUTION, 3)
    assert np.isfinite(made.files["image"]).all()
    ties = [item for item in bpy.data.objects if item.name.startswith(f"{names.CABLE}.0.")]
    assert ties


def test_images_of_skins_go_with_their_picture(renderer: BlenderRenderer, header: DatasetHeader) -> None:
    """After five pictures there are no more images than after two."""
    counts = []
    for index in (0, 2, 4, 6, 8):
        renderer.make(Job(category=Category.CLOSE_CONCENTRATED, index=index), header)
        counts.append((len(bpy.data.images), len(bpy.data.materials), len(bpy.data.meshes)))
    assert max(counts[2:]) <= max(counts[:2])
