"""OpenImageIO and Blender, which brings an OpenImageIO of its own, in one process: same values, same pictures."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from assets.scan.float_image import read_float_image
from assets.scan.hdris import world_directory
from tests.assets.scan.float_files import write_image

pytestmark = pytest.mark.blender

PROGRAM = """
import hashlib, sys, tempfile
from pathlib import Path
import numpy as np

source, order = sys.argv[1:]

def read():
    from assets.scan.float_image import read_float_image
    return read_float_image(Path(source))

def render():
    import bpy
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, world, camera = bpy.context.scene, bpy.data.worlds.new("w"), bpy.data.cameras.new("c")
    scene.world, world.use_nodes = world, True
    light = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    light.image = bpy.data.images.load(source)
    world.node_tree.links.new(light.outputs[0], world.node_tree.nodes["Background"].inputs[0])
    scene.camera = bpy.data.objects.new("c", camera)
    scene.collection.objects.link(scene.camera)
    scene.camera.rotation_euler = (1.5, 0.0, 0.0)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 2, True
    scene.render.resolution_x = scene.render.resolution_y = 32
    scene.render.image_settings.file_format = "OPEN_EXR"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = folder + "/picture.exr"
        bpy.ops.render.render(write_still=True)
        picture = bpy.data.images.load(scene.render.filepath)
        pixels = np.empty(32 * 32 * 4, np.float32)
        picture.pixels.foreach_get(pixels)
    assert pixels.reshape(-1, 4)[:, :3].std() > 0.001
    return pixels

steps = {"read": read, "render": render}
for step in order.split():
    print(step, hashlib.sha256(steps[step]().tobytes()).hexdigest(), file=sys.stderr)
"""


def steps_of(order: str) -> list[str]:
    """What a fresh process that takes these steps says of each: its name and the checksum of its pixels."""
    command = [sys.executable, "-c", PROGRAM, str(world_directory() / "night.exr"), order]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [line for line in done.stderr.splitlines() if line.startswith(("read ", "render "))]


def test_neither_changes_what_the_other_gives() -> None:
    """In either order of their coming, a file's values and a rendered picture are those of a process of their own."""
    (read,), (render,) = steps_of("read"), steps_of("render")
    assert steps_of("read render read") == [read, render, read]
    assert steps_of("render read render") == [render, read, render]


def blenders(path: Path) -> NDArray[np.float32]:
    """A file's colours as Blender reads them, the top row first."""
    import bpy  # noqa: PLC0415  # not everywhere

    image = bpy.data.images.load(str(path), check_existing=False)
    try:
        columns, rows = image.size
        pixels = np.empty(rows * columns * 4, np.float32)
        image.pixels.foreach_get(pixels)
    finally:
        bpy.data.images.remove(image)
    return np.ascontiguousarray(pixels.reshape(rows, columns, 4)[::-1, :, :3])


def test_blenders_own_panoramas_have_the_values_that_blender_reads() -> None:
    """Every bit of all eight."""
    paths = sorted(world_directory().glob("*.exr"))
    assert len(paths) == 8
    for path in paths:
        assert read_float_image(path).tobytes() == blenders(path).tobytes(), path.name


@pytest.mark.parametrize("compression", ["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"])
@pytest.mark.parametrize("kind", ["half", "float"])
@pytest.mark.parametrize("tile", [0, 32])
def test_every_kind_of_exr_file_has_the_values_that_blender_reads(
    tmp_path: Path, compression: str, kind: str, tile: int
) -> None:
    """With alpha beside the colours, which changes none of them; and values below 0, above 1 and close to 0."""
    pixels = np.random.default_rng(0).normal(0.5, 1.0, (40, 72, 4)).astype(np.float32)
    pixels[0, 0] = 1e-7
    path = write_image(tmp_path / "a.exr", pixels, kind=kind, compression=compression, tile=tile)
    assert read_float_image(path).tobytes() == blenders(path).tobytes()


@pytest.mark.parametrize("width", [6, 72])
def test_radiance_files_have_the_values_that_blender_reads(tmp_path: Path, width: int) -> None:
    """From the smallest to the largest exponents, with runs and without."""
    rng = np.random.default_rng(0)
    pixels = np.exp(rng.uniform(-60, 60, (40, width, 1))) * rng.random((40, width, 3))
    path = write_image(tmp_path / "a.hdr", pixels.astype(np.float32))
    assert read_float_image(path).tobytes() == blenders(path).tobytes()
