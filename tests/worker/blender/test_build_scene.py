"""Leaving things out of a scene doesn't change its picture."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

bpy = pytest.importorskip("bpy")

from assets.surfaces.bake import bake_surfaces  # noqa: E402  # after importorskip
from blend import names  # noqa: E402
from blend.world import is_as_built  # noqa: E402
from farm.cli.installed_assets import InstalledAssets  # noqa: E402
from farm.run.worker_settings import DeviceChoice, RendererSettings  # noqa: E402
from farm.scene.camera import Camera  # noqa: E402
from farm.scene.picture_size import PictureSize  # noqa: E402
from farm.spec.category import Category  # noqa: E402
from farm.spec.header import DatasetHeader  # noqa: E402
from farm.spec.job import Job  # noqa: E402
from farm.spec.make_header import Inputs, make_header  # noqa: E402
from farm.spec.parse import parse_spec  # noqa: E402
from farm.spec.quality import REFERENCE  # noqa: E402
from farm.spec.rendering import CyclesSettings, Denoiser, Economy, PictureSettings  # noqa: E402
from worker.blender.build_scene import BuiltScene  # noqa: E402
from worker.blender.renderer import BlenderRenderer, open_renderer  # noqa: E402
from worker.geometry import SettledGeometry  # noqa: E402
from worker.sample.scene import sample_scene  # noqa: E402
from worker.simulate.simulate import simulate  # noqa: E402

pytestmark = pytest.mark.blender

SURFACES = ("concrete_smooth", "rusted_steel")
RESOLUTION = PictureSize.square(128)
PORTRAIT = PictureSize(width=80, height=128)

TILTED = Camera(
    height_m=0.12,
    f_number=8.0,
    focal_length_mm=35.0,
    tilt_deg=25.0,
    tilt_bearing_deg=130.0,
    roll_deg=50.0,
    focus_offset_m=0.005,
)


@pytest.fixture(scope="module")
def header() -> DatasetHeader:
    """The surfaces, small, and a fresh template open."""
    spec = parse_spec({"seed": 0, "style": "published", "images": 600}, source="test")
    made = make_header(spec, Inputs(environments=False), InstalledAssets())
    return made.model_copy(update={"surfaces": tuple(s for s in made.surfaces if s.name in SURFACES)})


@pytest.fixture
def renderer(header: DatasetHeader, tmp_path: Path) -> BlenderRenderer:
    """One with a fresh template and the surfaces, small."""
    bake_surfaces(tmp_path, pixels=512, names=SURFACES, processes=1)
    return open_renderer(header, RendererSettings(device=DeviceChoice.CPU, assets=tmp_path))


def set_up(
    header: DatasetHeader,
    renderer: BlenderRenderer,
    job: Job,
    samples: int,
    economy: Economy,
    camera: Camera | None = None,
    resolution: PictureSize = RESOLUTION,
) -> BuiltScene:
    """Make a job's scene ready to render, as seen by another camera if one is given."""
    scene = sample_scene(header, job, 0)
    scene = scene.model_copy(update={"camera": camera or scene.camera})
    shapes = simulate(scene, header.spec.simulator, header.spec.fall)
    settings = PictureSettings(cycles=CyclesSettings(samples=samples, denoiser=Denoiser.NONE), economy=economy)
    built = renderer.build(SettledGeometry(scene, shapes, settings.detail, resolution), economy)
    renderer.use_cycles(settings, resolution, scene.render_seed)
    return built


def picture(
    header: DatasetHeader,
    renderer: BlenderRenderer,
    category: Category,
    samples: int,
    economy: Economy,
    camera: Camera | None = None,
    resolution: PictureSize = RESOLUTION,
) -> NDArray[np.float64]:
    """The first picture of a category, levels 0 to 255."""
    built = set_up(header, renderer, Job(category=category, index=0), samples, economy, camera, resolution)
    return renderer.render(built).astype(np.float64)


def psnr_db(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Peak signal-to-noise ratio, dB."""
    return float(10 * np.log10(255.0**2 / max(np.mean((a - b) ** 2), 1e-9)))


@pytest.mark.parametrize("camera", [None, TILTED], ids=["down", "tilted"])
@pytest.mark.parametrize("field", ["texture_window", "cables_in_view"])
def test_what_is_out_of_view_is_not_missed(
    header: DatasetHeader, renderer: BlenderRenderer, field: str, camera: Camera | None
) -> None:
    """With the same samples, a lamp's picture stays the same to 45 dB, which is a level and a half."""
    whole = REFERENCE.economy
    without = whole.model_copy(update={field: True})
    less, more = (picture(header, renderer, Category.CLOSE_CONCENTRATED, 8, each, camera) for each in (without, whole))
    assert psnr_db(less, more) > 45


@pytest.mark.parametrize(
    ("camera", "resolution"),
    [(None, RESOLUTION), (TILTED, RESOLUTION), (TILTED, PORTRAIT)],
    ids=["down", "tilted", "portrait"],
)
def test_what_is_behind_is_what_paths_would_find(
    header: DatasetHeader, renderer: BlenderRenderer, camera: Camera | None, resolution: PictureSize
) -> None:
    """A far picture with the HDRI looked up is that of 256 samples to 35 dB, which leaves their noise."""
    looked_up = picture(header, renderer, Category.FAR, 64, Economy(), camera, resolution)
    sampled = picture(header, renderer, Category.FAR, 256, REFERENCE.economy, camera, resolution)
    assert psnr_db(looked_up, sampled) > 35
    assert looked_up.mean() == pytest.approx(sampled.mean(), rel=0.01)


def test_the_upper_world_lights_as_the_whole_does(header: DatasetHeader, renderer: BlenderRenderer) -> None:
    """A floor under an HDRI is as bright, within 2 %, and alike to 30 dB at samples that leave noise."""
    upper = picture(header, renderer, Category.CLOSE_DISTRIBUTED, 64, Economy())
    whole = picture(header, renderer, Category.CLOSE_DISTRIBUTED, 256, REFERENCE.economy)
    assert upper.mean() == pytest.approx(whole.mean(), rel=0.02)
    assert psnr_db(upper, whole) > 30


def test_a_world_that_an_artist_changed_is_sampled(header: DatasetHeader, renderer: BlenderRenderer) -> None:
    """With a node of theirs between HDRI and background, nothing is looked up in the HDRI alone."""
    tree = bpy.data.worlds[names.WORLD].node_tree
    assert is_as_built(bpy.data.worlds[names.WORLD])
    tint = tree.nodes.new("ShaderNodeGamma")
    tree.links.new(tree.nodes[names.WORLD_IMAGE].outputs["Color"], tint.inputs["Color"])
    tree.links.new(tint.outputs["Color"], tree.nodes["plain"].inputs["Color"])
    assert not is_as_built(bpy.data.worlds[names.WORLD])
    assert set_up(header, renderer, Job(category=Category.FAR, index=0), 1, Economy()).matte is None


def test_a_lens_that_an_artist_changed_is_sampled(header: DatasetHeader, renderer: BlenderRenderer) -> None:
    """Six blades blur to hexagons, which the disc does not."""
    bpy.data.objects[names.CAMERA].data.dof.aperture_blades = 6
    assert set_up(header, renderer, Job(category=Category.FAR, index=0), 1, Economy()).matte is None
