"""EXR and Radiance files for tests: sound ones of every kind, and EXR headers that say anything."""

import struct
from pathlib import Path

import numpy as np
import OpenImageIO
from numpy.typing import NDArray


def write_image(
    path: Path,
    pixels: NDArray[np.float32],
    *,
    kind: str = "float",
    compression: str = "zip",
    tile: int = 0,
    names: str = "",
) -> Path:
    """Write a file of the format that its suffix names.

    Args:
        path: Ends in .exr or .hdr.
        pixels: Shape (height, width, channels).
        kind: Kind of number that an EXR file holds.
        compression: Name of the compression of an EXR file.
        tile: Edge of an EXR file's tiles in pixels; 0 for scan lines.
        names: One letter for each channel; RGB or RGBA unless given.
    """
    height, width, channels = pixels.shape
    spec = OpenImageIO.ImageSpec(width, height, channels, kind)
    spec.attribute("compression", compression)
    spec.tile_width = spec.tile_height = tile
    if names:
        spec.channelnames = tuple(names)
    target = OpenImageIO.ImageOutput.create(str(path))
    assert target.open(str(path), spec), target.geterror()
    assert target.write_image(np.ascontiguousarray(pixels, np.float32)), target.geterror()
    assert target.close()
    return path


def exr_header(
    width: int, height: int, *, channels: int = 3, tile: tuple[int, int] = (0, 0), flags: int = 0, note: bytes = b""
) -> bytes:
    """An EXR file that is nothing but a header and a kilobyte of zeros.

    Args:
        width: Announced pixels across.
        height: Announced pixels down.
        channels: Announced channels of half floats, three of which are B, G and R.
        tile: Announced width and height of a tile; zeros for scan lines.
        flags: Bits of the version field.
        note: Value of an attribute that nothing reads.
    """
    names = sorted([b"B", b"G", b"R", *(b"c%d" % number for number in range(channels - 3))])
    listed = b"".join(name + b"\0" + struct.pack("<IIii", 1, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    attributes = [
        (b"channels", b"chlist", listed),
        (b"compression", b"compression", b"\3"),
        (b"dataWindow", b"box2i", window),
        (b"displayWindow", b"box2i", window),
        (b"lineOrder", b"lineOrder", b"\0"),
        (b"note", b"string", note),
        (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        (b"screenWindowCenter", b"v2f", bytes(8)),
        (b"screenWindowWidth", b"float", struct.pack("<f", 1)),
    ]
    if any(tile):
        attributes.append((b"tiles", b"tiledesc", struct.pack("<IIB", *tile, 0)))
        flags |= 0x200
    body = b"".join(
        name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value for name, kind, value in attributes
    )
    return b"\x76\x2f\x31\x01" + struct.pack("<I", 2 | flags) + body + bytes(1024)
