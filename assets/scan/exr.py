"""OpenEXR files: is every chunk there, and what do the pixels say."""

import os
import struct
from pathlib import Path

# OpenCV reads EXR files only where this is set; it looks at it when it meets the first one.
os.environ.setdefault("OPENCV_IO_ENABLE_OPENEXR", "1")

import cv2
import numpy as np
import numpy.typing as npt

from farm.errors import AssetError

MAGIC = b"\x76\x2f\x31\x01"
TILED, DEEP, MULTIPART = 0x200, 0x800, 0x1000
LINES_PER_CHUNK = {0: 1, 1: 1, 2: 1, 3: 16, 4: 32, 5: 16, 6: 32, 7: 32, 8: 32, 9: 256}
"""Scan lines in a chunk, by the number of the compression method in the file format."""

LARGEST_EDGE = 16384
LARGEST_PIXELS = 2**26
"""Checking that many takes about 3 GB; a few megabytes may claim them."""

AGAIN = "download or export it again"


def decode_exr(path: Path, data: bytes) -> npt.NDArray[np.float32]:
    """Decode an EXR file completely.

    Args:
        path: Where it comes from, for messages.
        data: The whole file.

    Returns:
        Pixels, shape (height, width, 3), linear, channels red green blue.

    Raises:
        AssetError: It is truncated, damaged, of an unsupported kind, or not an EXR file.
    """
    check_exr(path, data)
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise AssetError(f"{path}: OpenCV can't decode this EXR file ({error.err}); {AGAIN}") from error
    if image is None:
        raise AssetError(f"{path}: can't be decoded as EXR; {AGAIN}")
    return colour_channels(image)


def colour_channels(image: npt.NDArray[np.generic]) -> npt.NDArray[np.float32]:
    """Turn an image as OpenCV decodes it (grey, BGR or BGRA) into shape (height, width, 3), red green blue."""
    pixels = np.asarray(image, np.float32)
    if pixels.ndim == 2:
        return np.repeat(pixels[..., None], 3, axis=2)
    return np.ascontiguousarray(pixels[..., 2::-1])


def check_exr(path: Path, data: bytes) -> tuple[int, int]:
    """Check that every chunk that an EXR file announces lies within it.

    Args:
        path: Where it comes from, for messages.
        data: The whole file.

    Returns:
        Width and height in pixels.

    Raises:
        AssetError: It is truncated, damaged, of an unsupported kind, or not an EXR file.
    """
    if not data.startswith(MAGIC):
        raise AssetError(f"{path}: isn't an EXR file, whatever its name says; {AGAIN}")
    try:
        return _check_chunks(path, data)
    except (struct.error, IndexError, ValueError, KeyError) as error:
        raise AssetError(f"{path}: is truncated or damaged in its header or offset table; {AGAIN}") from error


def _check_chunks(path: Path, data: bytes) -> tuple[int, int]:
    version = struct.unpack_from("<I", data, 4)[0]
    if version & (DEEP | MULTIPART):
        raise AssetError(f"{path}: deep and multi-part EXR files aren't supported; export a plain one")
    attributes, table = _header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    if not (1 <= width <= LARGEST_EDGE and 1 <= height <= LARGEST_EDGE):
        raise AssetError(f"{path}: {width} x {height} pixels is outside 1 to {LARGEST_EDGE} an edge; resize it")
    if width * height > LARGEST_PIXELS:
        raise AssetError(f"{path}: {width} x {height} pixels is more than {LARGEST_PIXELS // 2**20} Mi; resize it")
    if version & TILED:
        # The first tile follows the table of offsets directly; each entry has 8 bytes.
        first = min(struct.unpack_from("<Q", data, table))
        count, head = (first - table) // 8, 20
    else:
        lines = LINES_PER_CHUNK[attributes["compression"][0]]
        count, head = -(-height // lines), 8
    for offset in struct.unpack_from(f"<{count}Q", data, table):
        if not table + 8 * count <= offset <= len(data) - head:
            raise AssetError(f"{path}: a chunk is said to start at byte {offset} of {len(data)}; {AGAIN}")
        size = struct.unpack_from("<I", data, offset + head - 4)[0]
        if offset + head + size > len(data):
            raise AssetError(
                f"{path}: is truncated: a chunk ends {offset + head + size - len(data)} bytes "
                f"after the end of the file; {AGAIN}"
            )
    return width, height


def _header(data: bytes) -> tuple[dict[str, bytes], int]:
    """The attributes of the header, and where the offset table starts."""
    attributes: dict[str, bytes] = {}
    place = 8
    while data[place] != 0:
        name_end = data.index(b"\0", place)
        type_end = data.index(b"\0", name_end + 1)
        size = struct.unpack_from("<I", data, type_end + 1)[0]
        start = type_end + 5
        attributes[data[place:name_end].decode("latin-1")] = data[start : start + size]
        place = start + size
    return attributes, place + 1
