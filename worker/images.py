"""The images that a process holds: each loaded once, the least used let go when there are too many."""

from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from farm.errors import AssetError

Key = tuple[str, bool, bool, bool]


@dataclass(frozen=True, slots=True)
class _Loaded:
    """An image and its size, noted once: asking Blender for it later decodes the file again."""

    image: Any
    bytes: int


class ImageShelf:
    """Blender images by file, up to a number of bytes in all."""

    def __init__(self, capacity_bytes: int = 2**30) -> None:
        """Start empty."""
        self._capacity_bytes = capacity_bytes
        self._loaded: OrderedDict[Key, _Loaded] = OrderedDict()
        self._constants: dict[str, Any] = {}

    def load(self, path: Path, *, colour: bool = False, invert: bool = False, flip_green: bool = False) -> Any:
        """An image from a file.

        Args:
            path: of the file.
            colour: sRGB, as against plain numbers; HDR files are linear either way.
            invert: turn glossiness into roughness.
            flip_green: turn a normal map from DirectX to OpenGL convention.

        Raises:
            AssetError: if Blender can't read it.
        """
        key = (str(path), colour, invert, flip_green)
        if key in self._loaded:
            self._loaded.move_to_end(key)
            return self._loaded[key].image
        image = self._read(path, colour=colour)
        if invert or flip_green:
            _alter(image, invert=invert, flip_green=flip_green)
        self._loaded[key] = _Loaded(image, _bytes(image))
        # A picture needs five images at most; those stay, however large.
        while len(self._loaded) > _IN_USE and sum(each.bytes for each in self._loaded.values()) > self._capacity_bytes:
            _, oldest = self._loaded.popitem(last=False)
            bpy.data.images.remove(oldest.image)
        return image

    def constant(self, value: float, *, colour: bool = False) -> Any:
        """An image of one grey value, linear."""
        return self._constant(f"constant {value:.4f}", (value, value, value), colour=colour)

    def flat_normal(self) -> Any:
        """A normal map without relief."""
        return self._constant("flat normal", (0.5, 0.5, 1.0), colour=False)

    def _constant(self, name: str, value: tuple[float, float, float], *, colour: bool) -> Any:
        if name not in self._constants:
            image = bpy.data.images.new(name, 1, 1, float_buffer=True, is_data=not colour)
            image.pixels[:] = (*value, 1.0)
            image.use_fake_user = True
            self._constants[name] = image
        return self._constants[name]

    @staticmethod
    def _read(path: Path, *, colour: bool) -> Any:
        try:
            image = bpy.data.images.load(str(path), check_existing=False)
        except RuntimeError as error:
            raise AssetError(f"{path}: Blender can't read this image") from error
        if not image.size[0]:
            bpy.data.images.remove(image)
            raise AssetError(f"{path}: Blender can't decode this image; replace the file")
        if path.suffix.lower() not in {".exr", ".hdr"}:
            image.colorspace_settings.name = "sRGB" if colour else "Non-Color"
        return image


_IN_USE = 5


def _bytes(image: Any) -> int:
    """Memory of an image's pixels: four channels of a byte or a float."""
    width, height = image.size
    return int(width * height * 4 * (4 if image.is_float else 1))


def _alter(image: Any, *, invert: bool, flip_green: bool) -> None:
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    channels = pixels.reshape(-1, 4)
    if invert:
        channels[:, :3] = 1.0 - channels[:, :3]
    if flip_green:
        channels[:, 1] = 1.0 - channels[:, 1]
    image.pixels.foreach_set(pixels)
    image.update()
