"""The one reader of texture maps that aren't EXR: the check of a folder and the workers decode by it.

OpenCV decodes, since its levels are those that pictures have. What it can't decode, such as TIFF files with Zstandard's
compression, OpenImageIO or Pillow decodes.
"""

import os
import struct
import warnings
from contextlib import nullcontext, suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from assets.files import read_bounded
from assets.scan.float_image import open_image, quiet_standard_error
from farm.errors import AssetError

FORMATS = ("JPEG", "PNG", "TIFF", "WEBP", "BMP")
SMALLEST_EDGE, LARGEST_EDGE = 16, 16384
"""Pixels along an edge that are accepted."""

LARGEST_PIXELS = 178_956_970
"""Pixels above which an image is refused: Pillow's own limit against files that unfold."""

NO_IMAGE = "its content is no image of a kind that is read"
"""What is said of a file that Pillow does not know, in place of its own words, which hold an address in memory."""

_TIFF_MAGICS = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_TIFF_COMPRESSIONS = frozenset({"none", "lzw", "zip", "packbits", "jpeg"})
"""Compressions that OpenImageIO 3.0 decodes rightly: of Zstandard and LZMA it makes other pixels, and so does Blender.
"""

_AS_THEY_ARE = frozenset({"L", "RGB", "RGBA", "I;16"})
"""Pillow's modes whose pixels are levels of 8 or 16 bits."""

_DAMAGE = (OSError, SyntaxError, ValueError, TypeError, KeyError, EOFError, struct.error)
"""What Pillow raises for damaged files."""

_ADVICE = "save it again as PNG or JPEG"


def check_texture(path: Path, data: bytes) -> tuple[int, int]:
    """Decode a map completely, by a strict reader, and make sure that a worker can decode it.

    Args:
        path: Path of the file, for error messages.
        data: The file's content.

    Returns:
        Pixels across and down.

    Raises:
        AssetError: It isn't a sound image, or its size is out of bounds.
    """
    size = _sound(path, data)
    if data.startswith(_TIFF_MAGICS):
        # Of other kinds, workers decode by Pillow, as was done here, what OpenCV can't.
        decode_texture(path, data)
    return size


def read_texture(path: Path) -> NDArray[Any]:
    """Read and decode a map; see `decode_texture`."""
    return decode_texture(path, read_bounded(path))


def decode_texture(path: Path, data: bytes) -> NDArray[Any]:
    """Decode a map as it is to be shown. A file that is cut short may give a part of its picture.

    Args:
        path: Path of the file, for error messages.
        data: The file's content.

    Returns:
        Shape (height, width), or (height, width, 3 or 4) with red first; the type is that of the file: 8 or 16 bits
        without sign, or others.

    Raises:
        AssetError: It can't be decoded.
    """
    pixels = opencv_pixels(data)
    if pixels is None:
        return _by_other_reader(path, data)
    if pixels.ndim == 2:
        return pixels
    if pixels.dtype == np.float64:
        pixels = pixels.astype(np.float32)
    return cv2.cvtColor(pixels, cv2.COLOR_BGR2RGB if pixels.shape[2] == 3 else cv2.COLOR_BGRA2RGBA)


def opencv_pixels(data: bytes) -> NDArray[Any] | None:
    """Decode a map by OpenCV, blue first; None if it can't."""
    try:
        # OpenCV warns of compressions of TIFF that it lacks.
        with quiet_standard_error() if data.startswith(_TIFF_MAGICS) else nullcontext():
            return cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        return None


def check_size(path: Path, width: int, height: int) -> None:
    """Check that a map has a size that can be used.

    Raises:
        AssetError: An edge is too short or too long.
    """
    if not (SMALLEST_EDGE <= width <= LARGEST_EDGE and SMALLEST_EDGE <= height <= LARGEST_EDGE):
        raise AssetError(
            f"{path}: {width} x {height} pixels is outside {SMALLEST_EDGE} to {LARGEST_EDGE} an edge; scale it"
        )
    if width * height > LARGEST_PIXELS:
        raise AssetError(f"{path}: has too many pixels to be decoded safely; scale it down")


def _sound(path: Path, data: bytes) -> tuple[int, int]:
    """Decode to the end by a reader that tells truncated files, which OpenCV shows in part."""
    try:
        with warnings.catch_warnings():
            # Pillow warns of large images and odd notes; the bounds above decide instead.
            warnings.simplefilter("ignore")
            with Image.open(BytesIO(data), formats=FORMATS) as image:
                check_size(path, image.width, image.height)
                image.load()
                return image.width, image.height
    except Image.DecompressionBombError as error:
        raise AssetError(f"{path}: has too many pixels to be decoded safely; scale it down") from error
    except UnidentifiedImageError as error:
        if data.startswith(_TIFF_MAGICS):  # of 10, 12 or more bits, which Pillow does not know
            height, width = _read_tiff(path).shape[:2]
            return width, height
        raise AssetError(f"{path}: isn't a sound image ({_short(error)}); {_ADVICE}") from error
    except _DAMAGE as error:
        raise AssetError(f"{path}: isn't a sound image ({_short(error)}); {_ADVICE}") from error


def _short(error: Exception) -> str:
    return NO_IMAGE if isinstance(error, UnidentifiedImageError) else str(error)


def _by_other_reader(path: Path, data: bytes) -> NDArray[Any]:
    if data.startswith(_TIFF_MAGICS):
        with suppress(AssetError):
            return _read_tiff(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with Image.open(BytesIO(data), formats=FORMATS) as image:
                return np.asarray(image if image.mode in _AS_THEY_ARE else image.convert("RGB"))
    except (Image.DecompressionBombError, *_DAMAGE) as error:
        raise AssetError(f"{path}: can't decode this image ({_short(error)}); {_ADVICE}") from error


def _read_tiff(path: Path) -> NDArray[Any]:
    """Decode a TIFF file by OpenImageIO, which knows all kinds of pixels, such as those of 4 and 12 bits."""
    with quiet_standard_error():
        source, reason = open_image(os.fsencode(path))
        if source is None:
            raise AssetError(f"{path}: isn't a sound image ({reason()}); {_ADVICE}")
        try:
            spec = source.spec()
            check_size(path, spec.width, spec.height)
            compression = spec.get_string_attribute("compression")
            if compression not in _TIFF_COMPRESSIONS:
                raise AssetError(f"{path}: isn't a sound image (compressed by {compression}); {_ADVICE}")
            channels = spec.nchannels if spec.nchannels in {1, 3, 4} else 1 if spec.nchannels == 2 else 3
            kind = str(spec.format) if str(spec.format) in {"uint8", "uint16"} else "float"
            pixels = source.read_image(0, 0, 0, channels, kind)
            if pixels is None:
                raise AssetError(f"{path}: isn't a sound image ({reason()}); {_ADVICE}")
        finally:
            source.close()
    decoded = np.asarray(pixels)
    return np.ascontiguousarray(decoded[..., 0]) if channels == 1 else decoded
