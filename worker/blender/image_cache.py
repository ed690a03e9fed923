"""The images that a process holds: each file is read once, and the least used are let go when there are too many."""

import contextlib
from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from assets.files import read_bounded
from assets.scan.float_image import FLOAT_SUFFIXES, read_float_image
from assets.scan.photographs import decode_plate
from assets.scan.texture_image import opencv_pixels, read_texture
from farm.errors import AssetError
from worker.colour import Texels

Pixels = NDArray[np.uint8] | NDArray[np.float32]

_TIFF_SUFFIXES = frozenset({".tif", ".tiff"})

_IN_USE = 6
"""Images from files that one picture needs at most. The last six used stay, however large."""


@dataclass(frozen=True, slots=True)
class TextureFile:
    """A floor's map in a file, and how to read it.

    Attributes:
        path: the file.
        colour: whether it holds sRGB colours, not plain numbers.
        invert: whether to turn glossiness into roughness.
        flip_green: whether to turn a normal map from DirectX to OpenGL convention.
    """

    path: Path
    colour: bool = False
    invert: bool = False
    flip_green: bool = False


class ImageCache:
    """Images by file, up to a number of bytes in all.

    Args:
        capacity_bytes: most bytes that are kept for later pictures.
    """

    def __init__(self, capacity_bytes: int = 2**30) -> None:
        self._capacity_bytes = capacity_bytes
        self._held: OrderedDict[tuple[object, ...], tuple[Any, int]] = OrderedDict()
        self._constants: dict[str, Any] = {}
        self._of_picture: list[Any] = []
        self._scratch = np.empty(0, np.float32)

    def begin_picture(self) -> None:
        """Let go the images of the picture before."""
        for image in self._of_picture:
            bpy.data.images.remove(image)
        self._of_picture.clear()

    def forget(self) -> None:
        """Let go everything that is kept for later pictures."""
        while self._held:
            _release(self._held.popitem()[1][0])

    def panorama(self, path: Path) -> Any:
        """An HDRI as a Blender image.

        Raises:
            AssetError: if Blender can't read it.
        """
        return self._hold((str(path), "panorama"), lambda: _sized(_load(path)))

    def radiance(self, path: Path) -> NDArray[np.float32]:
        """An HDRI as (H, W, 3) linear light, the top row first; don't write to it.

        Raises:
            AssetError: if it can't be decoded.
        """

        def read() -> tuple[NDArray[np.float32], int]:
            pixels = read_float_image(path)
            return pixels, pixels.nbytes

        light: NDArray[np.float32] = self._hold((str(path), "radiance"), read)
        return light

    def photograph(self, path: Path) -> NDArray[np.uint8]:
        """A photograph as (H, W, 3) sRGB, the top row first; don't write to it.

        Raises:
            AssetError: if it can't be decoded.
        """

        def read() -> tuple[NDArray[np.uint8], int]:
            pixels = decode_plate(path, read_bounded(path))
            return pixels, pixels.nbytes

        pixels: NDArray[np.uint8] = self._hold((str(path), "photograph"), read)
        return pixels

    def texels(self, file: TextureFile, *, reduced: bool = False) -> Texels | None:
        """A map's texels, (H, W) or (H, W, 3) with red first, the top row first; don't write to them.

        Args:
            file: the map.
            reduced: whether to reduce 16 bits to 8 and to leave out alpha.

        Returns:
            None if the file then is neither grey nor RGB with 8 bits a channel.

        Raises:
            AssetError: if it can't be read.
        """
        if file.path.suffix.lower() in FLOAT_SUFFIXES:
            return None
        texels: Texels | None = self._hold((str(file.path), file, reduced), lambda: _decode(file, reduced=reduced))
        return texels

    def whole(self, file: TextureFile) -> Any:
        """A map as a Blender image, read by Blender if it can, else by the reader that checked it.

        Raises:
            AssetError: if it can't be read.
        """

        def read() -> tuple[Any, int]:
            image = _load_texture(file)
            if file.invert or file.flip_green:
                pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
                image.pixels.foreach_get(pixels)
                _alter(pixels.reshape(1, -1, 4), 1.0, invert=file.invert, flip_green=file.flip_green)
                image.pixels.foreach_set(pixels)
                image.update()
            return _sized(image)

        return self._hold((str(file.path), ("whole", file)), read)

    def for_picture(self, name: str, pixels: Pixels, *, colour: bool) -> Any:
        """Pixels as a Blender image that goes with the present picture.

        Args:
            name: name of the image.
            pixels: (H, W) or (H, W, 3) with red first, the top row first: 8 bits as a file has them, or linear floats.
            colour: whether they are colours, not plain numbers such as roughness.
        """
        rows, columns = pixels.shape[:2]
        is_float = pixels.dtype == np.float32
        image = bpy.data.images.new(name, columns, rows, float_buffer=is_float, is_data=not colour)
        # Blender counts rows from below, and takes four channels in single precision whatever it keeps.
        channels = cv2.cvtColor(pixels[::-1], cv2.COLOR_RGB2RGBA if pixels.ndim == 3 else cv2.COLOR_GRAY2RGBA)
        if not is_float:
            channels = np.multiply(channels, np.float32(1 / 255), out=self._scratch_like(channels))
        image.pixels.foreach_set(channels.ravel())
        image.update()
        self._of_picture.append(image)
        return image

    def constant(self, value: float, *, colour: bool = False) -> Any:
        """An image of one grey value, linear."""
        return self._constant(f"constant {value:.4f}", (value, value, value), colour=colour)

    def flat_normal(self) -> Any:
        """A normal map without relief."""
        return self._constant("flat normal", (0.5, 0.5, 1.0), colour=False)

    def _scratch_like(self, array: NDArray[Any]) -> NDArray[np.float32]:
        """Room in single precision for an array, until the next call: fresh memory costs more than the arithmetic."""
        if self._scratch.size < array.size:
            self._scratch = np.empty(array.size, np.float32)
        room: NDArray[np.float32] = self._scratch[: array.size].reshape(array.shape)
        return room

    def _constant(self, name: str, value: tuple[float, float, float], *, colour: bool) -> Any:
        if name not in self._constants:
            image = bpy.data.images.new(name, 1, 1, float_buffer=True, is_data=not colour)
            image.pixels[:] = (*value, 1.0)
            image.use_fake_user = True
            self._constants[name] = image
        return self._constants[name]

    def _hold(self, key: tuple[object, ...], read: Any) -> Any:
        if key in self._held:
            self._held.move_to_end(key)
            return self._held[key][0]
        self._held[key] = read()
        while len(self._held) > _IN_USE and sum(size for _, size in self._held.values()) > self._capacity_bytes:
            _release(self._held.popitem(last=False)[1][0])
        return self._held[key][0]


def _release(held: Any) -> None:
    if isinstance(held, bpy.types.Image):
        bpy.data.images.remove(held)


def _sized(image: Any) -> tuple[Any, int]:
    """An image with its bytes: four channels of a byte or a float. Asking later would decode the file again."""
    width, height = image.size
    return image, int(width * height * 4 * (4 if image.is_float else 1))


def _load(path: Path) -> Any:
    try:
        image = bpy.data.images.load(str(path), check_existing=False)
    except RuntimeError as error:
        raise AssetError(f"{path}: Blender can't read this image") from error
    if not image.size[0]:
        bpy.data.images.remove(image)
        raise AssetError(f"{path}: Blender can't decode this image; replace the file")
    return image


def _load_texture(file: TextureFile) -> Any:
    """Load a map by Blender, or by the reader that checked it if Blender can't, or makes other pixels of it."""
    suffix = file.path.suffix.lower()
    if suffix in FLOAT_SUFFIXES:
        return _load(file.path)
    if suffix not in _TIFF_SUFFIXES or opencv_pixels(read_bounded(file.path)) is not None:
        with contextlib.suppress(AssetError):
            image = _load(file.path)
            image.colorspace_settings.name = "sRGB" if file.colour else "Non-Color"
            return image
    pixels = _reduced(read_texture(file.path))
    rows, columns = pixels.shape[:2]
    image = bpy.data.images.new(file.path.name, columns, rows, is_data=not file.colour)
    channels = cv2.cvtColor(pixels[::-1], cv2.COLOR_RGB2RGBA if pixels.ndim == 3 else cv2.COLOR_GRAY2RGBA)
    image.pixels.foreach_set((channels / np.float32(255)).ravel())
    image.update()
    return image


def _reduced(pixels: NDArray[Any]) -> NDArray[Any]:
    """Reduce 16 bits to 8, and leave out alpha."""
    if pixels.dtype == np.uint16:
        pixels = (pixels // 256).astype(np.uint8)
    return pixels[:, :, :3] if pixels.ndim == 3 and pixels.shape[2] == 4 else pixels


def _decode(file: TextureFile, *, reduced: bool) -> tuple[Texels | None, int]:
    pixels = read_texture(file.path)
    if reduced:
        pixels = _reduced(pixels)
    if pixels.dtype != np.uint8 or (pixels.ndim == 3 and pixels.shape[2] != 3):
        return None, 0
    texels = np.require(pixels, np.uint8, ["C", "W"])
    _alter(texels, 255, invert=file.invert, flip_green=file.flip_green)
    return texels, texels.nbytes


def _alter(pixels: NDArray[Any], most: float, *, invert: bool, flip_green: bool) -> None:
    """Change pixels in place: (H, W), or (H, W, channels) with three colours first, of values from 0 to `most`."""
    colours = pixels if pixels.ndim == 2 else pixels[..., :3]
    if invert:
        colours[...] = most - colours
    if flip_green and colours.ndim == 3:
        colours[..., 1] = most - colours[..., 1]
