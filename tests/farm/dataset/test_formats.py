"""Types of file: what was encoded is read back."""

from typing import Any

import cv2
import numpy as np
import pytest

from farm.dataset.formats import PNG
from farm.errors import RenderError


def noise(shape: tuple[int, ...], kind: Any) -> Any:
    """Pixels of every value of a type."""
    draw = np.random.Generator(np.random.PCG64(1))
    return draw.integers(0, np.iinfo(kind).max, shape, dtype=kind, endpoint=True)


@pytest.mark.parametrize(("shape", "kind"), [((5, 7, 3), np.uint8), ((5, 7), np.uint8), ((5, 7), np.uint16)])
def test_png_keeps_every_value(shape: tuple[int, ...], kind: Any) -> None:
    """A PNG gives back the pixels, in 8 and in 16 bits."""
    pixels = noise(shape, kind)
    decoded = PNG.decode(PNG.encode(pixels))
    assert decoded is not None
    assert decoded.dtype == kind
    assert np.array_equal(decoded, pixels)


def test_png_is_red_first() -> None:
    """A reader of its own sees the colours in their places."""
    pixels = noise((5, 7, 3), np.uint8)
    blue_first = cv2.imdecode(np.frombuffer(PNG.encode(pixels), np.uint8), cv2.IMREAD_UNCHANGED)
    assert blue_first is not None
    assert np.array_equal(blue_first[:, :, ::-1], pixels)


def test_png_repeats() -> None:
    """The same pixels give the same bytes."""
    assert PNG.encode(noise((5, 7, 3), np.uint8)) == PNG.encode(noise((5, 7, 3), np.uint8))


@pytest.mark.parametrize("content", [b"", b"no picture", PNG.encode(noise((5, 7), np.uint8))[:30]])
def test_what_is_no_png(content: bytes) -> None:
    """Bytes that are no whole PNG are none, and no error."""
    assert PNG.decode(content) is None


def test_what_no_png_can_hold() -> None:
    """Pixels of two channels are refused."""
    with pytest.raises(RenderError, match="shape"):
        PNG.encode(noise((5, 7, 2), np.uint8))
