"""Renders into memory: the bytes are those of a file, and no folder takes part."""

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from assets.scan.float_image import read_float_image  # noqa: E402  # after importorskip
from blend.memory_file import memory_file  # noqa: E402
from blend.rendered import read_plain_exr, render_file, save_file  # noqa: E402
from farm.errors import DestinationError, RenderError  # noqa: E402

pytestmark = pytest.mark.blender

EXR = ("OPEN_EXR", "RGBA", "32")
PNG = ("PNG", "RGB", "8")


@pytest.fixture
def scene() -> Iterator[Any]:
    """A cube before a grey world, 24 x 16 pixels."""
    bpy.ops.wm.read_factory_settings()
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.render.dither_intensity = "CYCLES", 1, 0.0
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 24, 16, 100
    yield scene
    bpy.ops.wm.read_factory_settings()


def choose(scene: Any, kind: tuple[str, str, str]) -> None:
    """Set the kind of file that a render gives."""
    image = scene.render.image_settings
    image.file_format, image.color_mode, image.color_depth = kind
    image.exr_codec, image.compression = "NONE", 0


def rendered_to_disk(scene: Any, path: Path) -> Path:
    """Render as Blender usually does."""
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    return path


@pytest.mark.parametrize("transparent", [False, True])
@pytest.mark.parametrize("mode", ["RGB", "RGBA"])
def test_light_in_memory_is_that_of_a_file(scene: Any, tmp_path: Path, mode: str, transparent: bool) -> None:
    """Linear light has the same bits in memory and on disk."""
    choose(scene, ("OPEN_EXR", mode, "32"))
    scene.render.film_transparent = transparent
    on_disk = read_float_image(rendered_to_disk(scene, tmp_path / "light.exr"))
    in_memory = read_plain_exr(render_file(scene))
    assert in_memory.shape == (16, 24, 3)
    assert in_memory.tobytes() == on_disk.tobytes()
    assert np.ptp(in_memory) > 0


def test_cropped_light(scene: Any, tmp_path: Path) -> None:
    """A render of some rows alone has their bits, too."""
    choose(scene, EXR)
    render = scene.render
    render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.0, 1.0, 0.25, 0.75
    on_disk = read_float_image(rendered_to_disk(scene, tmp_path / "light.exr"))
    assert read_plain_exr(render_file(scene)).tobytes() == on_disk.tobytes()


def test_picture_in_memory_is_that_of_a_file(scene: Any, tmp_path: Path) -> None:
    """A picture through the view transform has the same pixels in memory and on disk."""
    choose(scene, PNG)
    on_disk = cv2.imread(str(rendered_to_disk(scene, tmp_path / "picture.png")))
    in_memory = cv2.imdecode(np.frombuffer(render_file(scene), np.uint8), cv2.IMREAD_COLOR)
    assert on_disk is not None
    assert np.array_equal(in_memory, on_disk)


def test_no_folder_is_needed(scene: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no folder for short-lived files can be written, a picture is made all the same."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "nowhere"))
    choose(scene, PNG)
    assert render_file(scene)
    image = bpy.data.images.new("light", 4, 4, float_buffer=True)
    assert save_file(image, scene)


@pytest.mark.parametrize("cut", [0, 3, 100, 400, 1000, -1])
def test_file_that_is_cut_off(scene: Any, cut: int) -> None:
    """A file that ends early is refused."""
    choose(scene, EXR)
    content = render_file(scene)
    with pytest.raises(RenderError, match="EXR"):
        read_plain_exr(content[:cut])


@pytest.mark.parametrize(("depth", "codec"), [("16", "NONE"), ("32", "ZIP")])
def test_other_kinds_of_files(scene: Any, depth: str, codec: str) -> None:
    """Half floats and compressed lines, which nobody asks Blender for, are refused."""
    choose(scene, ("OPEN_EXR", "RGB", depth))
    scene.render.image_settings.exr_codec = codec
    with pytest.raises(RenderError, match="EXR"):
        read_plain_exr(render_file(scene))


def test_a_memory_file_starts_empty_and_takes_what_is_written() -> None:
    """Whatever opens its path by name may write it, from the start each time."""
    with memory_file() as file:
        assert file.content() == b""
        for content in (b"longer than the next", b"next"):
            file.path.write_bytes(content)
            assert file.content() == content


def test_memory_that_can_not_be_had(monkeypatch: pytest.MonkeyPatch) -> None:
    """A system that gives no file is told as a full disk is, so that the worker waits."""

    def refuse(_: str) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.memfd_create", refuse)
    with pytest.raises(DestinationError, match="No space left on device; name a folder by TMPDIR"), memory_file():
        pass
