"""Radiance .hdr files: is every scan line there, and what do the pixels say."""

import re
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from assets.scan.exr import LARGEST_PIXELS, colour_channels
from farm.errors import AssetError

LARGEST_EDGE = 16384
SMALLEST_RUN_WIDTH, LARGEST_RUN_WIDTH = 8, 32767
"""Widths, in pixels, for which the format has run-length coded lines."""

AGAIN = "download or export it again"
RESOLUTION = re.compile(rb"\n\n-Y (\d{1,6}) \+X (\d{1,6})\n")


def decode_radiance(path: Path, data: bytes) -> npt.NDArray[np.float32]:
    """Decode a Radiance file completely.

    Args:
        path: Where it comes from, for messages.
        data: The whole file.

    Returns:
        Pixels, shape (height, width, 3), linear, channels red green blue.

    Raises:
        AssetError: It is truncated, damaged, of an unsupported kind, or not a Radiance file.
    """
    check_radiance(path, data)
    try:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise AssetError(f"{path}: OpenCV can't decode this Radiance file ({error.err}); {AGAIN}") from error
    if image is None:
        raise AssetError(f"{path}: can't be decoded as Radiance HDR; {AGAIN}")
    return colour_channels(image)


def check_radiance(path: Path, data: bytes) -> tuple[int, int]:
    """Walk through all scan lines of a Radiance file.

    Args:
        path: Where it comes from, for messages.
        data: The whole file.

    Returns:
        Width and height in pixels.

    Raises:
        AssetError: It is truncated, damaged, stored in an unusual orientation, or not a Radiance file.
    """
    if not data.startswith((b"#?RADIANCE", b"#?RGBE")):
        raise AssetError(f"{path}: isn't a Radiance file, whatever its name says; {AGAIN}")
    found = RESOLUTION.search(data, 0, 65536)
    if found is None:
        raise AssetError(f"{path}: has no line like '-Y 1024 +X 2048' after its header; export it the usual way up")
    height, width = int(found[1]), int(found[2])
    if not (1 <= width <= LARGEST_EDGE and 1 <= height <= LARGEST_EDGE):
        raise AssetError(f"{path}: {width} x {height} pixels is outside 1 to {LARGEST_EDGE} an edge; resize it")
    if width * height > LARGEST_PIXELS:
        raise AssetError(f"{path}: {width} x {height} pixels is more than {LARGEST_PIXELS // 2**20} Mi; resize it")
    place = found.end()
    if not _has_runs(data, place, width):
        if len(data) - place < 4 * width * height:
            raise AssetError(
                f"{path}: is truncated: {4 * width * height - len(data) + place} bytes are missing; {AGAIN}"
            )
        return width, height
    for line in range(height):
        end = _line_end(data, place, width)
        if end is None:
            raise AssetError(f"{path}: is truncated or damaged at scan line {line} of {height}; {AGAIN}")
        place = end
    return width, height


def _has_runs(data: bytes, place: int, width: int) -> bool:
    """Whether the lines are run-length coded: such a line starts with 2, 2 and its width."""
    if not SMALLEST_RUN_WIDTH <= width <= LARGEST_RUN_WIDTH:
        return False
    return data[place : place + 4] == bytes([2, 2, width >> 8, width & 255])


def _line_end(data: bytes, place: int, width: int) -> int | None:
    """Where a run-length coded line ends, or None if it isn't whole."""
    if not _has_runs(data, place, width):
        return None
    place += 4
    length = len(data)
    for _ in range(4):
        filled = 0
        while filled < width:
            if place >= length:
                return None
            count = data[place]
            # Above 128 one value is repeated; up to 128 that many values follow.
            repeated = count > 128
            filled += count - 128 if repeated else count
            place += 2 if repeated else count + 1
            if count == 0:
                return None
        if filled != width or place > length:
            return None
    return place
