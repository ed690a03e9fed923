"""Images that a process keeps."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image

from tests.assets.scan.float_files import write_image

pytestmark = pytest.mark.blender


def test_pixels_for_a_picture_become_an_image() -> None:
    """Blender counts rows from below and levels from 0 to 1."""
    from worker.blender.image_cache import ImageCache  # noqa: PLC0415

    levels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    image = ImageCache().for_picture("levels", levels, colour=False)
    assert np.allclose(np.reshape(image.pixels, (2, 4, 4))[::-1, :, :3], levels / 255, atol=1e-6)


def test_images_of_a_picture_go_with_it() -> None:
    """The next picture begins without them."""
    import bpy  # noqa: PLC0415

    from worker.blender.image_cache import ImageCache  # noqa: PLC0415

    cache = ImageCache()
    name = cache.for_picture("passing", np.zeros((2, 2), np.uint8), colour=True).name
    cache.begin_picture()
    assert name not in bpy.data.images


def test_the_light_of_a_panorama_is_read_once(tmp_path: Path) -> None:
    """The next picture gets the same array, though the file is gone."""
    from worker.blender.image_cache import ImageCache  # noqa: PLC0415

    light = np.random.default_rng(0).random((16, 32, 3), np.float32)
    path = write_image(tmp_path / "hall.exr", light)
    cache = ImageCache()
    first = cache.radiance(path)
    path.unlink()
    assert np.array_equal(first, light)
    assert cache.radiance(path) is first


def test_glossiness_in_grey_becomes_roughness_all_over(tmp_path: Path) -> None:
    """Grey and coloured glossiness become roughness in all columns."""
    from worker.blender.image_cache import ImageCache, TextureFile  # noqa: PLC0415

    path = tmp_path / "gloss.png"
    cv2.imwrite(str(path), np.full((8, 16), 200, np.uint8))
    texels = ImageCache().texels(TextureFile(path, invert=True))
    assert texels is not None
    assert (texels == 55).all()


@pytest.mark.parametrize(
    ("suffix", "compression"), [("tif", "zstd"), ("tif", "tiff_lzw"), ("tif", "lzma"), ("bmp", "")]
)
def test_a_map_is_the_same_by_each_way(tmp_path: Path, suffix: str, compression: str) -> None:
    """Blender makes other pixels of some compressions, and refuses some files that the check of a folder takes."""
    from worker.blender.image_cache import ImageCache, TextureFile  # noqa: PLC0415

    levels = cv2.resize(np.random.default_rng(0).integers(0, 255, (4, 4, 3), np.uint8), (64, 48))
    path = tmp_path / f"oak_color.{suffix}"
    Image.fromarray(levels).save(path, **({"compression": compression} if compression else {}))
    cache = ImageCache()
    texels = cache.texels(TextureFile(path, colour=True))
    assert texels is not None
    assert np.array_equal(texels, levels)
    image = cache.whole(TextureFile(path, colour=True))
    assert image.colorspace_settings.name == "sRGB"
    seen = np.reshape(image.pixels, (48, 64, 4))[::-1, :, :3]
    assert np.allclose(seen, levels / 255, atol=1e-4)
