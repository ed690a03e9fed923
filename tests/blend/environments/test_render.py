"""Environments, built by Blender and rendered small."""

import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from assets.environments import (
    BRIGHTEST,
    ENVIRONMENTS,
    TARGET_LUMINANCE,
    EnvironmentKind,
    load_environment,
    missing_environments,
)
from assets.scan.float_image import read_float_image
from assets.scan.hdris import mean_luminance, read_hdri
from blend.environments import render as environments
from blend.environments.assembly import Assembly
from blend.environments.build import Built, assemble, build_environment
from blend.environments.materials import is_known
from blend.environments.render import normalised, render_environments, without_seam, write_environment
from blend.environments.scene import Light, stage
from farm.errors import AssetError, RenderError
from farm.run.worker_settings import DeviceChoice, RendererSettings

pytestmark = pytest.mark.blender

FEWEST_THINGS, FEWEST_SOLIDS = 40, 1000
PIXELS = 256


@pytest.fixture(autouse=True)
def coarse_surfaces(monkeypatch: pytest.MonkeyPatch) -> None:
    """Floors of few texels, which are quick to draw."""
    monkeypatch.setattr("blend.environments.materials.SURFACE_PIXELS", 64)


@pytest.fixture(scope="module")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with one rendered environment."""
    folder = tmp_path_factory.mktemp("assets")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("blend.environments.materials.SURFACE_PIXELS", 64)
        names = list(
            render_environments(
                folder, pixels=PIXELS, names=("storeroom_2", "yard_2"), device=DeviceChoice.CPU, threads=0
            )
        )
    assert names == ["storeroom_2", "yard_2"]
    return folder


def content() -> list[tuple[str, bytes]]:
    """Names of the open file's meshes, images and lamps."""
    found: list[tuple[str, bytes]] = []
    for collection, values, width in (("meshes", "vertices", 3), ("images", "pixels", 1)):
        for block in getattr(bpy.data, collection):
            held = getattr(block, values)
            numbers = np.empty(len(held) * width, np.float32)
            held.foreach_get(*(("co",) if width == 3 else ()), numbers)
            found.append((block.name, numbers.tobytes()))
    lamps = [(lamp.name, repr((lamp.type, lamp.energy, tuple(lamp.color))).encode()) for lamp in bpy.data.lights]
    return sorted(found + lamps)


def shapes(assembly: Assembly) -> list[tuple[str, bytes, bytes]]:
    """Points and tints of every part."""
    return [
        (material, part.points.tobytes(), part.tint.tobytes())
        for material, parts in sorted(assembly.parts.items())
        for part in parts
    ]


@pytest.mark.parametrize("name", list(ENVIRONMENTS))
def test_every_environment_is_furnished_and_lit(name: str) -> None:
    """Each has many things of many materials, and lamps or the sun; nothing stands in the camera."""
    assembly, light = assemble(ENVIRONMENTS[name])
    assert assembly.things > FEWEST_THINGS
    assert sum(len(parts) for parts in assembly.parts.values()) > FEWEST_SOLIDS
    assert len(assembly.parts) >= 10
    assert all(is_known(material) for material in assembly.parts)
    assert "glow" in assembly.parts or light.sun > 0
    camera = np.array(light.camera_m)
    for parts in assembly.parts.values():
        for part in parts:
            assert np.isfinite(part.points).all()
            low, high = part.points.min(axis=0), part.points.max(axis=0)
            assert not ((low < camera) & (camera < high) & (high - low < 3.0)).all()


def test_two_builds_agree() -> None:
    """Two builds of a recipe give the same scene."""
    recipe = ENVIRONMENTS["workshop_2"]
    before = shapes(build_environment(recipe).assembly)
    described = content()
    assert shapes(build_environment(recipe).assembly) == before
    assert content() == described


def test_variants_differ() -> None:
    """The two variants of a kind are different places."""
    assert shapes(assemble(ENVIRONMENTS["office_1"])[0]) != shapes(assemble(ENVIRONMENTS["office_2"])[0])


def test_a_panorama_can_light_a_scene(rendered: Path) -> None:
    """A panorama passes every check of a user's own HDRI, with the intended brightness."""
    found = read_hdri(load_environment(rendered, "storeroom_2").path)
    assert found.mean_luminance == pytest.approx(TARGET_LUMINANCE, rel=0.02)
    assert found.backdrop
    assert not found.dark


def test_a_panorama_is_no_even_grey(rendered: Path) -> None:
    """A panorama has dark corners, bright lamps, and colours."""
    for name in ("storeroom_2", "yard_2"):
        light = read_float_image(load_environment(rendered, name).path)
        assert light.shape == (PIXELS // 2, PIXELS, 3)
        luminance = light.mean(axis=2)
        assert np.percentile(luminance, 99) > 8 * np.percentile(luminance, 5)
        assert np.abs(light[..., 0] - light[..., 2]).mean() > 0.02
        assert light.max() <= BRIGHTEST * 1.05


def test_what_is_there_is_not_rendered_again(rendered: Path) -> None:
    """A panorama that exists isn't even touched."""
    before = {path: path.stat().st_mtime_ns for path in rendered.rglob("*.*")}
    assert (
        list(render_environments(rendered, pixels=PIXELS, names=("yard_2",), device=DeviceChoice.CPU, threads=0)) == []
    )
    assert {path: path.stat().st_mtime_ns for path in rendered.rglob("*.*")} == before
    assert "storeroom_2" not in {recipe.name for recipe in missing_environments(rendered, PIXELS)}


def test_the_middle_column_looks_along_x(monkeypatch: pytest.MonkeyPatch) -> None:
    """What lies to the right of +x is at -y, as in `worker.backdrop.panorama`, and the zenith is at the top."""

    def three_lamps(_recipe: object) -> Built:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        rng = np.random.default_rng(0)
        a = Assembly(rng)
        for place, tint in (((5, 0, -0.5), (9, 0, 0)), ((0, -5, -0.5), (0, 9, 0)), ((0, 0, 5), (0, 0, 9))):
            a.box((float(place[0]), float(place[1]), float(place[2])), (1, 1, 1), "glow", tint)
        light = Light((0.0, 0.0, 0.0), sky=0.0, ambient=(0, 0, 0))
        return Built(stage(a, light, rng), a, light)

    monkeypatch.setattr(environments, "build_environment", three_lamps)
    seen = environments.render_panorama(ENVIRONMENTS["yard_1"], 64, DeviceChoice.CPU, 0)
    assert np.argmax(seen[16, 32]) == 0
    assert np.argmax(seen[16, 48]) == 1
    assert np.argmax(seen[0, 10]) == 2
    assert min(seen[16, 32, 0], seen[16, 48, 1], seen[0, 10, 2]) > 1.0
    assert seen[16, 16].max() < 0.1


def test_the_band_about_the_horizon_is_the_finer(monkeypatch: pytest.MonkeyPatch) -> None:
    """Above and below the band a coarser render shows the same scene, and the two meet without a step."""
    sizes: list[tuple[int, int, int]] = []

    def ramp(_scene: object, pixels: int, first: int, last: int) -> NDArray[np.float32]:
        sizes.append((pixels, first, last))
        height = (np.arange(first, last) + 0.5) / (pixels // 2)
        return np.broadcast_to(height[:, None, None], (last - first, pixels, 3)).astype(np.float32)

    monkeypatch.setattr(environments, "_render", ramp)
    monkeypatch.setattr(
        environments, "build_environment", lambda _: Built(None, Assembly(np.random.default_rng(0)), Light((0, 0, 0)))
    )
    monkeypatch.setattr(environments, "configure", lambda *_: None)
    light = environments.render_panorama(ENVIRONMENTS["yard_1"], 1024, DeviceChoice.CPU, 0)
    assert sizes == [(256, 0, 128), (1024, 171, 341)]
    rows = (np.arange(512) + 0.5) / 512
    assert light[2:-2, 0, 0] == pytest.approx(rows[2:-2], abs=2e-3)


def test_the_seam_is_mended() -> None:
    """A small step between the first and last column goes, an object's edge and the middle stay."""
    light = np.ones((64, 256, 3), np.float32)
    light[:32, :128] = 1.06
    light[32:, :128] = 3.0
    mended = without_seam(light)
    assert np.abs(mended[4:28, 0] - mended[4:28, -1]).max() < 0.02
    assert np.array_equal(mended[40:], light[40:])
    assert np.array_equal(mended[:, 8:-8], light[:, 8:-8])


def test_bright_lamps_are_clipped_and_the_mean_is_kept() -> None:
    """Scale and clipping are found together."""
    light = np.full((64, 128, 3), 0.1, np.float32)
    light[30:34, 60:64] = 500.0
    light[0, 0] = -1.0
    scaled = normalised(light)
    assert scaled.min() == 0.0
    assert scaled.max() == BRIGHTEST
    assert mean_luminance(scaled) == pytest.approx(TARGET_LUMINANCE, rel=0.01)


@pytest.mark.parametrize("value", [0.0, np.nan, np.inf])
def test_light_that_can_not_be_used_is_refused(value: float) -> None:
    """Light that is black, undefined or infinite is refused."""
    with pytest.raises(RenderError):
        normalised(np.full((8, 16, 3), value, np.float32))


def test_a_panorama_reads_back_as_written(tmp_path: Path) -> None:
    """Compression loses less than a hundredth of the visible light."""
    ramp = np.linspace(0.02, 3.0, 128, dtype=np.float32)
    light = np.broadcast_to(ramp[None, :, None], (64, 128, 3)).copy()
    write_environment(tmp_path, ENVIRONMENTS["factory_1"], light)
    found = load_environment(tmp_path, "factory_1")
    assert found.record.kind is EnvironmentKind.FACTORY
    back = read_float_image(found.path)
    assert back == pytest.approx(light, rel=0.02, abs=0.005)


@pytest.mark.parametrize("pixels", [0, 63, 129, 10_000])
def test_sizes_that_make_no_panorama_are_refused(tmp_path: Path, pixels: int) -> None:
    """A size that isn't a panorama's is refused before anything is rendered."""
    with pytest.raises(AssetError, match="even number"):
        list(render_environments(tmp_path, pixels=pixels, names=None, device=DeviceChoice.CPU, threads=0))


def test_the_workers_command_tells_each_name(tmp_path: Path, rendered: Path) -> None:
    """Standard output has a line for each environment, the log Blender's messages; a second run prints nothing."""
    command = [sys.executable, "-P", "-m", "worker", "environments", "--logs", str(tmp_path / "logs")]
    renderer = RendererSettings(device=DeviceChoice.CPU).as_argument()
    small = ["--renderer", renderer, "--pixels", "64", "--name", "switch_room_1", "--out"]
    made = subprocess.run([*command, *small, str(tmp_path)], capture_output=True, text=True, check=False)
    assert (made.returncode, made.stdout, made.stderr) == (0, "switch_room_1\n", "")
    assert load_environment(tmp_path, "switch_room_1").record.pixels == 64
    assert "Fra:" in (tmp_path / "logs" / "environments.log").read_text()
    there = ["--pixels", str(PIXELS), "--name", "yard_2", "--out", str(rendered)]
    idle = subprocess.run([*command, *there], capture_output=True, text=True, check=False)
    assert (idle.returncode, idle.stdout) == (0, "")


def test_the_workers_command_refuses_an_unknown_name(tmp_path: Path) -> None:
    """An unknown name has the exit code of an asset's error."""
    command = [sys.executable, "-P", "-m", "worker", "environments", "--logs", str(tmp_path)]
    done = subprocess.run(
        [*command, "--out", str(tmp_path), "--name", "cave"], capture_output=True, text=True, check=False
    )
    assert done.returncode == AssetError.exit_code
    assert "unknown environment 'cave'" in done.stderr
