"""The whole-image benchmark with Blender: other programs' defaults, the rendered mask, and one small run."""

import argparse
import json
from pathlib import Path

import numpy as np
import pytest

from farm.errors import SpecError, VerificationError
from farm.spec.category import Category
from farm.spec.job import Job
from tests.worker.settled import rod, shapes

bpy = pytest.importorskip("bpy")

from benchmarks.bench_dataset import bench_header  # noqa: E402
from benchmarks.physics import published_cloth as published  # noqa: E402
from benchmarks.render.stage_set import SettledScene, Stage  # noqa: E402
from benchmarks.whole.command import run  # noqa: E402
from benchmarks.whole.options import add_whole, plan_of  # noqa: E402
from benchmarks.whole.plan import Plan  # noqa: E402
from benchmarks.whole.published import render_mask, verify_mask  # noqa: E402
from benchmarks.whole.renderings import BLENDER, BLENDERPROC, set_picture  # noqa: E402
from benchmarks.whole.rows import STAGES  # noqa: E402
from blend import names  # noqa: E402  # after importorskip
from worker.sample.scene import sample_scene  # noqa: E402

pytestmark = pytest.mark.blender

JOB = Job(category=Category.FAR, index=0)
SAMPLING = (
    "samples",
    "use_adaptive_sampling",
    "adaptive_threshold",
    "adaptive_min_samples",
    "max_bounces",
    "diffuse_bounces",
    "glossy_bounces",
    "transmission_bounces",
    "transparent_max_bounces",
    "volume_bounces",
    "caustics_reflective",
    "caustics_refractive",
    "sample_clamp_direct",
    "sample_clamp_indirect",
    "use_light_tree",
    "sampling_pattern",
    "use_denoising",
    "denoising_quality",
    "denoising_prefilter",
    "denoising_input_passes",
    "time_limit",
    "filter_width",
)


@pytest.fixture(scope="module")
def stage() -> Stage:
    """The open template."""
    return Stage(bench_header(1, 0), 256)


@pytest.fixture
def far() -> SettledScene:
    """Two cables that cross below the camera, under an HDRI that exists."""
    scene = sample_scene(bench_header(1, 0), JOB, 0)
    two = scene.model_copy(update={"cables": (scene.cables * 2)[:2]})
    return SettledScene(JOB, two, shapes(rod(), rod(along_y=True, z=0.003)))


def test_blenders_defaults_are_those_of_blender(stage: Stage, far: SettledScene) -> None:
    """Every setting of the sampling is that of a new file, whatever was set before."""
    set_picture(stage, far, BLENDERPROC)
    set_picture(stage, far, BLENDER)
    cycles = bpy.data.scenes[names.PICTURE_SCENE].cycles
    fresh = bpy.data.scenes.new("fresh")
    try:
        for name in SAMPLING:
            assert getattr(cycles, name) == getattr(fresh.cycles, name), name
    finally:
        bpy.data.scenes.remove(fresh)
    assert bpy.data.worlds[names.WORLD].cycles.sampling_method == "AUTOMATIC"


def test_blenderprocs_defaults_differ_in_samples_and_paths(stage: Stage, far: SettledScene) -> None:
    """BlenderProc takes at most 1,024 samples and three bounces, none of them glossy."""
    set_picture(stage, far, BLENDERPROC)
    cycles = bpy.data.scenes[names.PICTURE_SCENE].cycles
    assert (cycles.samples, cycles.adaptive_min_samples, cycles.use_denoising) == (1024, 0, True)
    assert (cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces) == (3, 3, 0)
    assert (cycles.transmission_bounces, cycles.volume_bounces, cycles.transparent_max_bounces) == (0, 0, 8)


def test_a_rendered_mask_is_of_its_scene_and_no_other(stage: Stage, far: SettledScene) -> None:
    """The mask from geometry agrees with the rendered one, and the mask of other cables doesn't."""
    set_picture(stage, far, BLENDER)
    bpy.data.scenes[names.PICTURE_SCENE].cycles.samples = 4
    mask = render_mask()
    assert set(np.unique(mask)) == {0, 255}
    verify_mask(mask, far)
    with pytest.raises(VerificationError, match="agrees to"):
        verify_mask(mask, SettledScene(JOB, far.scene, shapes(rod(y=0.02), rod(y=-0.02))))


def test_options_are_the_plans() -> None:
    """An option that isn't given has the plan's default."""
    parser, shared = argparse.ArgumentParser(), argparse.ArgumentParser(add_help=False)
    shared.add_argument("--seed", type=int, default=0)
    add_whole(parser.add_subparsers(), shared)
    assert plan_of(parser.parse_args(["whole"])) == Plan()
    given = parser.parse_args(
        ["whole", "--seed", "4", "--images", "3", "--slow-images", "2", "--growth-images", "0", "--no-errors"]
    )
    assert plan_of(given) == Plan(seed=4, images=3, slow_images=2, growth_images=0, errors=False)


def test_more_slow_images_than_images_are_refused(tmp_path: Path) -> None:
    """More slow images than images are refused, as the slow ones are among them."""
    with pytest.raises(SpecError, match="--slow-images"):
        run(tmp_path, Plan(images=1, slow_images=2))


@pytest.mark.slow
def test_a_small_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One scene of 32 pixels is made in every way; the published cables hardly begin to fall."""
    monkeypatch.setattr(published, "FRAMES", 2)
    plan = Plan(
        images=1,
        growth_images=1,
        resolution=32,
        errors=False,
        categories=(Category.FAR,),
        growth_categories=(Category.FAR,),
        resolutions=(32, 64),
        counts=(1, 2, 9),
    )
    assert run(tmp_path, plan) == 0
    content = json.loads((tmp_path / "whole.json").read_text())
    assert list(content["ways"]) == ["standard", "published", "BlenderProc's defaults", "Blender's defaults"]
    assert list(content["ways"]["published"]["seconds"]["far"]) == list(STAGES)
    assert list(content["ways"]["Blender's defaults"]["seconds"]["far"]) == ["realize", "render"]
    assert all(each["times"] > 1 for each in content["ratios"])
    assert [point["value"] for point in content["growth"]] == [1, 2, 9, 32, 64]
    assert content["peak_memory_mib"] > 100
    assert (tmp_path / "whole.png").exists()
