"""Images that a process keeps."""

from pathlib import Path

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.blender


def test_pixels_for_a_picture_become_an_image() -> None:
    """Blender counts rows from below and levels from 0 to 1."""
    from worker.blender.image_cache import ImageCache  # noqa: PLC0415
    from worker.blender.pixels import rgb_of  # noqa: PLC0415

    levels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    image = ImageCache().for_picture("levels", levels, colour=False)
    assert np.allclose(rgb_of(image), levels / 255, atol=1e-6)


def test_images_of_a_picture_go_with_it() -> None:
    """The next picture begins without them."""
    import bpy  # noqa: PLC0415

    from worker.blender.image_cache import ImageCache  # noqa: PLC0415

    cache = ImageCache()
    name = cache.for_picture("passing", np.zeros((2, 2), np.uint8), colour=True).name
    cache.begin_picture()
    assert name not in bpy.data.images


def test_glossiness_in_grey_becomes_roughness_all_over(tmp_path: Path) -> None:
    """Grey and coloured glossiness become roughness in all columns."""
    from worker.blender.image_cache import ImageCache, TextureFile  # noqa: PLC0415

    path = tmp_path / "gloss.png"
    cv2.imwrite(str(path), np.full((8, 16), 200, np.uint8))
    texels = ImageCache().texels(TextureFile(path, invert=True))
    assert texels is not None
    assert (texels == 55).all()
