"""Renders a scene of Blender into memory: Blender gives a picture only as a file, so it gets one that is no file."""

from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from blend.memory_file import memory_file
from farm.errors import RenderError

_MAGIC = b"\x76\x2f\x31\x01"
_OTHER_KINDS = 0x1A00
"""Flags of EXR files that are tiled, deep or in several parts."""

_FLOAT = 2
"""EXR's number for channels of 32-bit floats."""

_NOTHING_WRITTEN = "Blender ended a render without writing a picture; see the worker's log"


def render_file(scene: Any) -> bytes:
    """Render a scene; returns the file that its image settings describe.

    Raises:
        RenderError: if Blender gives no picture.
    """
    render = scene.render
    with memory_file() as file:
        render.filepath, render.use_file_extension = str(file.path), False
        try:
            bpy.ops.render.render(write_still=True, scene=scene.name)
        except RuntimeError as error:
            raise RenderError(f"Blender failed to render: {' '.join(str(error).split())}") from error
        return _written(file.content())


def save_file(image: Any, scene: Any) -> bytes:
    """Put an image through a scene's view transform; returns the file that the scene's image settings describe.

    Raises:
        RenderError: if Blender gives no picture.
    """
    with memory_file() as file:
        image.save_render(str(file.path), scene=scene)
        return _written(file.content())


def _written(content: bytes) -> bytes:
    if not content:
        raise RenderError(_NOTHING_WRITTEN)
    return content


def read_plain_exr(content: bytes) -> NDArray[np.float32]:
    """Decode an EXR file as Blender writes it when told so: scan lines of floats, not compressed.

    OpenImageIO's Python module, which reads all other EXR files here, reads none from memory. The format is described
    in https://openexr.com/en/latest/OpenEXRFileLayout.html.

    Returns:
        (H, W, 3), linear, channels red green blue, the top row first; alpha is left out.

    Raises:
        RenderError: if it is another kind of file, or is cut off.
    """
    try:
        attributes, start = _header(content)
        left, top, right, bottom = (int(number) for number in np.frombuffer(attributes["dataWindow"], "<i4"))
        names = [name for name, kind in _channels(attributes["channels"]) if kind == _FLOAT]
        rows, columns = bottom - top + 1, right - left + 1
        line = np.dtype([("y", "<i4"), ("bytes", "<i4"), ("channels", "<f4", (len(names), columns))])
        # Before the lines, a table tells where each begins, 8 bytes a line.
        lines = np.frombuffer(content, line, count=rows, offset=start + 8 * rows)
        plain = attributes["compression"] == b"\0" and np.array_equal(lines["y"], np.arange(top, bottom + 1))
        if not plain or (lines["bytes"] != 4 * len(names) * columns).any():
            raise ValueError("its lines are not plain ones")
        return np.stack([lines["channels"][:, names.index(name)] for name in "RGB"], axis=2)
    except (ValueError, KeyError, IndexError) as error:
        raise RenderError(
            f"Blender wrote an EXR file that is not as it was told: {error}; {_NOTHING_WRITTEN}"
        ) from error


def _header(content: bytes) -> tuple[dict[str, bytes], int]:
    """Read an EXR header: its attributes by name, and the number of its bytes."""
    if content[:4] != _MAGIC or int.from_bytes(content[4:8], "little") & _OTHER_KINDS:
        raise ValueError("no file of scan lines")
    attributes, place = {}, 8
    while content[place]:
        # An attribute is its name and type, each ended by a zero, the length of its value, and the value.
        end = content.index(b"\0", place)
        length = content.index(b"\0", end + 1) + 1
        value = length + 4
        after = value + int.from_bytes(content[length:value], "little")
        attributes[content[place:end].decode("ascii", "replace")] = content[value:after]
        place = after
    return attributes, place + 1


def _channels(listed: bytes) -> Iterator[tuple[str, int]]:
    """Yield the name and the number of the type of each channel, in the order in which a line holds them."""
    place = 0
    while listed[place]:
        end = listed.index(b"\0", place)
        yield listed[place:end].decode("ascii", "replace"), int.from_bytes(listed[end + 1 : end + 5], "little")
        # Type, a flag with three spare bytes, and the sampling across and down.
        place = end + 17
