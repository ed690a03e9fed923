"""The types of file that a picture's outputs have: how each is encoded, and read back.

A type that is not here yet, say JSON or EXR, is one more `FileFormat`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.errors import RenderError

_COMPRESSION = [cv2.IMWRITE_PNG_COMPRESSION, 1, cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE]
"""OpenCV's settings of zlib. They take a quarter of level 6's time for rendered pictures, and stay within 5 % of its
size."""


@dataclass(frozen=True, slots=True)
class FileFormat:
    """A type of file. The type of its content is its own: an array for PNG.

    Attributes:
        name: the word for it in messages.
        suffix: the end of a file's name, dot included.
        encode: makes a file's bytes; the same content gives the same bytes. Raises RenderError for content that can't
            be encoded.
        decode: reads a file's bytes back; None if they are no file of this type.
    """

    name: str
    suffix: str
    encode: Callable[[Any], bytes]
    decode: Callable[[bytes], Any | None]


def _encode_png(pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """Encode pixels (H, W) of 8 or 16 bits, or (H, W, 3) of 8 bits, red first."""
    ordered = pixels[:, :, ::-1] if pixels.ndim == 3 else pixels  # OpenCV has blue first
    try:
        encoded, data = cv2.imencode(".png", np.ascontiguousarray(ordered), _COMPRESSION)
    except cv2.error:
        encoded = False
    if not encoded:
        raise RenderError(f"can't encode a picture of shape {pixels.shape} and type {pixels.dtype}")
    return data.tobytes()


def _decode_png(content: bytes) -> NDArray[np.generic] | None:
    """Read pixels, red first."""
    if not content:
        return None  # OpenCV raises an error of its own
    pixels = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    if pixels is None:
        return None
    return pixels[:, :, ::-1] if pixels.ndim == 3 else pixels


PNG = FileFormat("PNG", ".png", _encode_png, _decode_png)
