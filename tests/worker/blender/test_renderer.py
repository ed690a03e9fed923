"""Real pictures from a real Blender: small, of every category, repeatable, and with right masks."""

import os
from itertools import islice
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from assets.surfaces.bake import bake_surfaces  # noqa: E402  # after importorskip
from benchmarks.masks.agreement import compare  # noqa: E402
from benchmarks.masks.reference import render_coverage  # noqa: E402
from benchmarks.pictures.drawn_coverage import drawn_coverage  # noqa: E402
from blend.build import TEMPLATE  # noqa: E402
from blend.contract import open_template  # noqa: E402
from farm.cli.installed_assets import InstalledAssets  # noqa: E402
from farm.errors import AssetError, SceneError, SpecError, TemplateError  # noqa: E402
from farm.run.worker_settings import DeviceChoice, RendererSettings  # noqa: E402
from farm.spec.category import Background, Category  # noqa: E402
from farm.spec.header import DatasetHeader, FileRef  # noqa: E402
from farm.spec.job import Job  # noqa: E402
from farm.spec.make_header import Inputs, make_header, template_ref  # noqa: E402
from farm.spec.parse import parse_spec  # noqa: E402
from worker.blender.asset_files import checked  # noqa: E402
from worker.blender.build_scene import BuiltScene, build_scene  # noqa: E402
from worker.blender.render import render_picture  # noqa: E402
from worker.blender.renderer import BlenderRenderer, open_renderer  # noqa: E402
from worker.geometry import SettledGeometry  # noqa: E402
from worker.simulate.checks.measure import settled_figures  # noqa: E402

pytestmark = pytest.mark.blender

SURFACES = ("concrete_smooth", "rusted_steel")


def small_header(**keys: object) -> DatasetHeader:
    """A header of draft pictures of 128 pixels over two surfaces and Blender's own HDRIs."""
    small = {"seed": 0, "style": "published", "images": 600, "resolution": 128, "quality": "draft"}
    spec = parse_spec({**small, **keys}, source="test")
    header = make_header(spec, Inputs(environments=False), InstalledAssets())
    return header.model_copy(update={"surfaces": tuple(s for s in header.surfaces if s.name in SURFACES)})


def on_cpu(assets: Path | None = None) -> RendererSettings:
    """A renderer on all cores of the CPU."""
    return RendererSettings(device=DeviceChoice.CPU, assets=assets)


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The two surfaces, small."""
    folder = tmp_path_factory.mktemp("surfaces")
    bake_surfaces(folder, pixels=256, names=SURFACES, processes=1)
    return folder


@pytest.fixture
def renderer(baked: Path) -> BlenderRenderer:
    """One whose template no other test has used."""
    return open_renderer(small_header(), on_cpu(baked))


@pytest.mark.parametrize("category", Category)
def test_every_category_gives_a_lit_picture_with_its_mask(renderer: BlenderRenderer, category: Category) -> None:
    """The mask has cables, and the picture is neither black nor flat."""
    made = renderer.make(Job(category=category, index=1), small_header())
    assert made.files["image"].shape == (128, 128, 3)
    assert 5 < made.files["image"].mean() < 250
    assert made.files["image"].std() > 3
    assert 0.005 < np.mean(made.files["mask"] == 255) < 0.6
    assert ((made.files["instances"] > 0) == (made.files["mask"] == 255)).all()


def test_a_header_without_settings_is_refused(baked: Path) -> None:
    """A header of another farm, without settings, isn't rendered with this farm's own."""
    header = small_header().model_copy(update={"rendering": {}})
    renderer = open_renderer(header, on_cpu(baked))
    with pytest.raises(SpecError, match="does not say how far is rendered"):
        renderer.make(Job(category=Category.FAR, index=0), header)


def test_a_cable_pixel_looks_unlike_the_picture_without_cables(renderer: BlenderRenderer) -> None:
    """Taking the cables away changes masked pixels far more than others."""
    header = small_header()
    made = renderer.make(Job(category=Category.CLOSE_CONCENTRATED, index=1), header)
    for cable in [item for item in bpy.data.objects if item.name.startswith("cable.")]:
        cable.hide_render = True
    change = np.abs(render_picture().astype(int) - made.files["image"].astype(int)).mean(axis=2)
    assert change[made.files["mask"] == 255].mean() > 5 * change[made.files["mask"] == 0].mean()


def test_a_picture_does_not_depend_on_those_before_it(renderer: BlenderRenderer, baked: Path) -> None:
    """The same bytes from a renderer that has made pictures of other categories and from a fresh one."""
    header = small_header()
    jobs = [Job(category=category, index=2) for category in Category]
    used = [renderer.make(job, header) for job in jobs]
    fresh = open_renderer(header, RendererSettings(device=DeviceChoice.CPU, threads=1, assets=baked))
    for job, before in reversed(list(zip(jobs, used, strict=True))):
        after = fresh.make(job, header)
        assert after.files["image"].tobytes() == before.files["image"].tobytes(), job.id
        assert after.files["instances"].tobytes() == before.files["instances"].tobytes(), job.id
        assert after.scene == before.scene


@pytest.mark.parametrize("category", [Category.CLOSE_CONCENTRATED, Category.FAR_ALIGNED])
def test_a_mask_agrees_with_an_emission_render(baked: Path, category: Category) -> None:
    """Against white cables on black, 64 samples, 512 pixels: edges agree within half a pixel, except in gaps."""
    header = small_header(resolution=512)
    made = open_renderer(header, on_cpu(baked)).make(Job(category=category, index=0), header)
    agreement = compare(made.files["instances"], render_coverage(made.scene.camera, samples=64))
    assert agreement.iou > 0.97
    assert agreement.edge_error_px <= 0.5
    assert agreement.gap_pixels < 50


@pytest.mark.parametrize("category", Category)
def test_the_floor_is_hidden_from_the_camera_in_far_pictures_alone(
    renderer: BlenderRenderer, category: Category
) -> None:
    """In far pictures the floor stays for physics and light."""
    renderer.make(Job(category=category, index=0), small_header())
    assert bpy.data.objects["floor"].visible_camera == (category.traits.background is Background.FLOOR)
    assert not bpy.data.objects["floor"].hide_render


def test_the_wind_moves_the_cables(baked: Path) -> None:
    """The masks of the same cables in the strongest wind and in none differ."""
    calm = small_header(ranges={"wind": {"strength": [0.0, 0.0]}})
    windy = small_header(ranges={"wind": {"strength": [10.0, 10.0]}})
    job = Job(category=Category.FAR, index=2)
    masks = [open_renderer(header, on_cpu(baked)).make(job, header).files["mask"] for header in (calm, windy)]
    assert np.mean(masks[0] != masks[1]) > 0.001


def test_settled_scenes_are_at_rest_whole_and_apart(renderer: BlenderRenderer) -> None:
    """In eight scenes gates 1 to 4 are at their targets."""
    for index in range(8):
        settled = renderer.make(Job(category=Category.FAR, index=index), small_header()).settled
        assert settled is not None
        missed = [gate.name for gate, figure in settled_figures(settled).items() if not gate.on_target(figure)]
        assert missed == []


def test_a_job_whose_scenes_all_fail_ends_in_a_scene_error(baked: Path) -> None:
    """Cables that have no time to land fail every attempt, and the error names all attempts."""
    header = small_header(
        fall={"max_attempts": 2, "rod": {"max_time_s": 0.05}},
        ranges={"placement": {"drop_height_m": 0.2}},
    )
    renderer = open_renderer(header, on_cpu(baked))
    with pytest.raises(SceneError, match=r"far-000000: none of 2 drawn scenes .* above"):
        renderer.make(Job(category=Category.FAR, index=0), header)


def test_a_rejected_scene_is_drawn_again_and_told_in_the_manifest(baked: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The next attempt's scene is shipped, and the manifest holds the reason against the first."""
    faults = iter(["length error 0.02 is above 0.01", None])
    monkeypatch.setattr("worker.simulate.settle.find_fault", lambda _: next(faults))
    header = small_header()
    made = open_renderer(header, on_cpu(baked)).make(Job(category=Category.FAR, index=0), header)
    assert made.scene.attempt == 1
    assert [(each.attempt, each.reason) for each in made.rejected] == [(0, "length error 0.02 is above 0.01")]


def test_a_scene_that_shows_too_little_is_not_built(baked: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The least visible share is judged on the mask before the picture is built, and the next scene is drawn."""
    job = Job(category=Category.FAR, index=5)
    seen = next(islice(drawn_coverage(small_header(), job.category, 6), 5, None))
    header = small_header(ranges={"cable": {"least_visible_share": round(seen + 0.001, 4)}})
    built: list[int] = []

    def counting(geometry: SettledGeometry, *others: Any) -> BuiltScene:
        built.append(geometry.scene.attempt)
        return build_scene(geometry, *others)

    monkeypatch.setattr("worker.blender.renderer.build_scene", counting)
    made = open_renderer(header, on_cpu(baked)).make(job, header)
    assert made.rejected[0].reason.startswith(f"cables are seen in {seen:.2%} of the picture")
    assert made.scene.attempt == len(made.rejected)
    assert np.mean(made.files["mask"] > 0) > seen
    assert built == [made.scene.attempt]


@pytest.mark.parametrize("category", [Category.CLOSE_CONCENTRATED, Category.CLOSE_ALIGNED_DISTRIBUTED, Category.FAR])
def test_a_picture_without_cables_is_a_lit_background(baked: Path, category: Category) -> None:
    """Floor, clutter and light are those of the job's picture with cables, and mask and instances are empty."""
    ranges = {"clutter": {"share": 1.0, "sticks": [2, 2]}}
    plain = small_header(ranges=ranges)
    bare = small_header(ranges={**ranges, "cable": {"background_share": 1.0, "least_visible_share": 0.01}})
    job = Job(category=category, index=0)
    cables, none = (open_renderer(header, on_cpu(baked)).make(job, header) for header in (plain, bare))
    assert (none.scene.cables, none.settled, none.rejected) == ((), None, ())
    assert not none.files["mask"].any()
    assert not none.files["instances"].any()
    change = np.abs(none.files["image"].astype(int) - cables.files["image"].astype(int)).mean(axis=2)
    assert change[cables.files["mask"] == 255].mean() > 3 * np.median(change[cables.files["mask"] == 0])
    assert none.files["image"].std() > 3


def test_cables_as_high_as_the_camera_are_never_rendered(baked: Path) -> None:
    """A dataset of an earlier release may ask for such a lens: every scene is refused, with the heights."""
    header = small_header(fall={"max_attempts": 2})
    camera = header.spec.ranges.camera.model_copy(update={"focal_lengths_mm": (1.0,)})
    ranges = header.spec.ranges.model_copy(update={"camera": camera})
    header = header.model_copy(update={"spec": header.spec.model_copy(update={"ranges": ranges})})
    with pytest.raises(SceneError, match=r"none of 2 drawn scenes .*cables or clutter are \d+\.\d mm high, above"):
        open_renderer(header, on_cpu(baked)).make(Job(category=Category.FAR, index=0), header)


def test_surfaces_that_are_not_baked_are_asked_for(tmp_path: Path) -> None:
    """The error names the command that bakes them."""
    header = small_header()
    renderer = open_renderer(header, on_cpu(tmp_path))
    with pytest.raises(AssetError, match="farm assets build"):
        renderer.make(Job(category=Category.CLOSE_CONCENTRATED, index=0), header)


def test_a_template_that_changed_since_the_submit_is_refused() -> None:
    """A template whose checksum differs from the header's is refused."""
    header = small_header()
    changed = header.model_copy(update={"template": header.template.model_copy(update={"sha256": "0" * 64})})
    with pytest.raises(AssetError, match="has changed"):
        open_renderer(changed, on_cpu())


def test_an_artists_template_that_lacks_something_is_refused(tmp_path: Path) -> None:
    """The error names what the template lacks."""
    path = tmp_path / "empty.blend"
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    header = make_header(
        parse_spec({"images": 6, "style": "published"}, source="test"),
        Inputs(template=path, environments=False),
        InstalledAssets(),
    )
    with pytest.raises(TemplateError, match="picture"):
        open_renderer(header, on_cpu())


def test_another_lens_in_the_template_does_not_spoil_the_masks(tmp_path: Path, baked: Path) -> None:
    """The published lens is set for every picture, as the masks assume it."""
    open_template(TEMPLATE)
    camera = bpy.data.objects["camera"]
    camera.data.lens, camera.data.shift_x, camera.rotation_euler.x = 35.0, 0.1, 0.2
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "lens.blend"), copy=True)
    header = small_header()
    artists = header.model_copy(update={"template": template_ref(tmp_path / "lens.blend")})
    job = Job(category=Category.FAR, index=1)
    ours = open_renderer(header, on_cpu(baked)).make(job, header)
    theirs = open_renderer(artists, on_cpu(baked)).make(job, artists)
    assert theirs.files["image"].tobytes() == ours.files["image"].tobytes()


def test_a_file_that_is_not_there_is_an_asset_error(tmp_path: Path) -> None:
    """The error names a file that isn't there."""
    with pytest.raises(AssetError, match=r"gone\.exr"):
        checked(FileRef(path=str(tmp_path / "gone.exr"), sha256="0" * 64))


@pytest.mark.slow
def test_eevee_renders_headless(baked: Path) -> None:
    """Through software OpenGL without a GPU, a picture resembles that of Cycles, a lamp's shadows included."""
    if os.environ.get("CI") != "true" and not any(Path("/usr/lib").glob("*/libEGL_mesa.so.0")):
        pytest.skip("no EGL: apt-get install libegl-mesa0 libgl1-mesa-dri")
    job = Job(category=Category.CLOSE_CONCENTRATED, index=1)
    pictures = []
    for engine in ("eevee", "cycles"):
        header = small_header(engine=engine, resolution=64)
        made = open_renderer(header, on_cpu(baked)).make(job, header)
        assert made.render.engine == engine
        pictures.append(made.files["image"].astype(float))
    assert np.corrcoef(pictures[0].ravel(), pictures[1].ravel())[0, 1] > 0.9


def test_a_photograph_stands_behind_far_cables(baked: Path, tmp_path: Path) -> None:
    """Every pixel without a cable shows the photograph, a plain red one; it takes part only if it is named."""
    cv2.imwrite(str(tmp_path / "red.png"), np.full((300, 400, 3), (20, 20, 200), np.uint8))
    plain = small_header(ranges={"plate": {"share": 1.0}})
    named = plain.model_copy(update={"plates": tuple(InstalledAssets().plates_in(tmp_path))})
    job = Job(category=Category.FAR, index=0)
    for header, is_red in ((named, True), (plain, False)):
        made = open_renderer(header, on_cpu(baked)).make(job, header)
        far = cv2.dilate(made.files["mask"], np.ones((9, 9), np.uint8)) == 0
        red, green, blue = (np.median(made.files["image"][far][:, channel]) for channel in range(3))
        assert bool(red > 1.5 * max(green, blue)) == is_red


def test_labels_without_a_render_cover_what_the_mask_does(renderer: BlenderRenderer) -> None:
    """The labels of a benchmark that renders nothing equal those of the pictures."""
    header = small_header()
    job = Job(category=Category.CLOSE_ALIGNED_CONCENTRATED, index=2)
    *_, last = drawn_coverage(header, job.category, job.index + 1)
    assert last == np.mean(renderer.make(job, header).files["mask"] > 0)
