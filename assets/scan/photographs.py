"""The user's own photographs, which stand behind the cables of far pictures."""

import struct
import warnings
from io import BytesIO
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageOps
from pydantic import BaseModel, ConfigDict, Field

from assets.files import Checksum, read_bounded, sha256
from farm.errors import AssetError

SUFFIXES = frozenset({".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff"})
FORMATS = ("JPEG", "PNG", "WEBP", "TIFF")

SMALLEST_EDGE = 256
"""Least pixels along the short side; a smaller photograph would be a blur behind any picture."""

MOST_PIXELS = 64 * 2**20
"""Largest number of pixels, those of 8192 x 8192. Decoding takes 10 bytes of memory for each of them, for a moment."""


class PlateFile(BaseModel):
    """A photograph that passed every check.

    Attributes:
        name: Unique within its folder.
        path: The file.
        sha256: Its checksum.
        width: Pixels across, as it is to be seen.
        height: Pixels down, as it is to be seen.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    path: Path
    sha256: Checksum
    width: int = Field(ge=SMALLEST_EDGE)
    height: int = Field(ge=SMALLEST_EDGE)


def scan_plates(folder: Path) -> tuple[PlateFile, ...]:
    """Read every JPEG, PNG, WebP and TIFF file in a folder.

    Args:
        folder: Its subfolders aren't read.

    Returns:
        The photographs, sorted by name.

    Raises:
        AssetError: There are none, two share a name, or one fails a check of `decode_plate`.
    """
    if not folder.is_dir():
        raise AssetError(f"{folder}: isn't a folder; give the folder that holds your photographs")
    paths = sorted(path for path in folder.iterdir() if path.suffix.lower() in SUFFIXES and path.is_file())
    paths = [path for path in paths if not path.name.startswith(".")]
    if not paths:
        raise AssetError(
            f"{folder}: holds no photograph ({', '.join(sorted(SUFFIXES))}); put some there or leave the folder out"
        )
    seen: dict[str, Path] = {}
    for path in paths:
        if path.stem in seen:
            raise AssetError(f"{path}: has the same name as {seen[path.stem].name}; rename or remove one")
        seen[path.stem] = path
    return tuple(read_plate(path) for path in paths)


def read_plate(path: Path) -> PlateFile:
    """Decode a photograph completely, to see that it can be.

    Raises:
        AssetError: See `decode_plate`.
    """
    data = read_bounded(path)
    height, width = decode_plate(path, data).shape[:2]
    return PlateFile(name=path.stem, path=path, sha256=sha256(data), width=width, height=height)


def decode_plate(path: Path, data: bytes) -> npt.NDArray[np.uint8]:
    """Decode the pixels of a photograph, turned as its EXIF note says; of several images in a file, the first.

    Args:
        path: Path of the file, for error messages.
        data: The file's content.

    Returns:
        Shape (height, width, 3), red green blue, read-only; taken for sRGB, whatever colour profile is attached.

    Raises:
        AssetError: It is truncated, damaged or of another format, not 8 bit RGB or grey, has more pixels than
            `MOST_PIXELS` or fewer than `SMALLEST_EDGE` along its short side.
    """
    try:
        with warnings.catch_warnings():
            # Pillow warns of large images and odd notes; the bounds below decide instead.
            warnings.simplefilter("ignore")
            with Image.open(BytesIO(data), formats=FORMATS) as image:
                _check_header(path, image)
                image.load()
                ImageOps.exif_transpose(image, in_place=True)
                return np.asarray(image if image.mode == "RGB" else image.convert("RGB"))
    except Image.DecompressionBombError as error:
        raise AssetError(f"{path}: has too many pixels to be decoded safely; scale it down") from error
    # What Pillow raises for damaged files and notes, beside its own UnidentifiedImageError, an OSError.
    except (OSError, SyntaxError, ValueError, TypeError, KeyError, EOFError, struct.error) as error:
        raise AssetError(f"{path}: isn't a sound photograph ({error}); save it again as JPEG or PNG") from error


def _check_header(path: Path, image: Image.Image) -> None:
    if image.width * image.height > MOST_PIXELS:
        raise AssetError(
            f"{path}: {image.width} x {image.height} is more than {MOST_PIXELS // 2**20} Mi pixels; scale it down"
        )
    if min(image.size) < SMALLEST_EDGE:
        raise AssetError(
            f"{path}: {image.width} x {image.height} is less than {SMALLEST_EDGE} pixels along its short side; "
            "use a larger one"
        )
    if image.mode not in {"RGB", "L"}:
        raise AssetError(f"{path}: is of mode {image.mode}; save it as 8 bit RGB or grey, without transparency")
