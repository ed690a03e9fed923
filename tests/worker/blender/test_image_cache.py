"""Images that a process keeps."""

from pathlib import Path

import cv2
import numpy as np
import pytest

pytestmark = pytest.mark.blender


def test_glossiness_in_grey_becomes_roughness_all_over(tmp_path: Path) -> None:
    """Grey and coloured glossiness become roughness in all columns."""
    from worker.blender.image_cache import ImageCache, TextureFile  # noqa: PLC0415

    path = tmp_path / "gloss.png"
    cv2.imwrite(str(path), np.full((8, 16), 200, np.uint8))
    texels = ImageCache().texels(TextureFile(path, invert=True))
    assert texels is not None
    assert (texels == 55).all()
