"""The user's own photographs, which stand behind the cables of far pictures."""

import struct
import warnings
from io import BytesIO
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageOps, UnidentifiedImageError
from pydantic import BaseModel, ConfigDict, Field

from assets.files import Checksum, read_bounded, sha256
from assets.scan.survey import Survey, entries_of, survey_files
from assets.scan.texture_image import NO_IMAGE
from farm.errors import AssetError

SUFFIXES = frozenset({".jpg", ".jpeg", ".png", ".webp", ".tif", ".tiff"})
FORMATS = ("JPEG", "PNG", "WEBP", "TIFF")

SMALLEST_EDGE = 256
"""Least pixels along the short side; a smaller photograph would be a blur behind any picture."""

MOST_PIXELS = 64 * 2**20
"""Largest number of pixels, those of 8192 x 8192. Decoding takes 10 bytes of memory for each of them, for a moment,
and 16 if some are transparent."""


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


def survey_plates(folder: Path) -> Survey[PlateFile]:
    """Read every JPEG, PNG, WebP and TIFF file in a folder.

    Args:
        folder: Its subfolders aren't read.

    Returns:
        The photographs, each with a name of its own, and the files that `decode_plate` refuses.

    Raises:
        AssetError: It is no folder, or can't be listed.
    """
    entries = entries_of(folder, "give the folder that holds your photographs")
    return survey_files(entries, SUFFIXES, "JPEG, PNG, WebP or TIFF", read_plate)


def scan_plates(folder: Path) -> tuple[PlateFile, ...]:
    """Read the photographs of a folder; see `survey_plates`.

    Returns:
        The photographs, sorted by name.

    Raises:
        AssetError: There is none that can be used.
    """
    return survey_plates(folder).needed(folder, f"no photograph ({', '.join(sorted(SUFFIXES))})")


def read_plate(path: Path, name: str | None = None) -> PlateFile:
    """Decode a photograph completely, to see that it can be.

    Args:
        path: The file.
        name: Name of the photograph; None for the file's own without suffix.

    Raises:
        AssetError: See `decode_plate`.
    """
    data = read_bounded(path)
    height, width = decode_plate(path, data).shape[:2]
    return PlateFile(name=name or path.stem, path=path, sha256=sha256(data), width=width, height=height)


def decode_plate(path: Path, data: bytes) -> npt.NDArray[np.uint8]:
    """Decode the pixels of a photograph, turned as its EXIF note says; of several images in a file, the first.

    Args:
        path: Path of the file, for error messages.
        data: The file's content.

    Returns:
        Shape (height, width, 3), red green blue, read-only; taken for sRGB, whatever colour profile is attached.
        Palettes and inks become RGB, 16 bits become 8, and what is transparent stands before white, as on a page.

    Raises:
        AssetError: It is truncated, damaged or of another format, holds floats or 32 bits, has more pixels than
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
                return np.asarray(_rgb(image))
    except Image.DecompressionBombError as error:
        raise AssetError(f"{path}: has too many pixels to be decoded safely; scale it down") from error
    except UnidentifiedImageError as error:
        raise AssetError(f"{path}: isn't a sound photograph ({NO_IMAGE}); save it again as JPEG or PNG") from error
    # What Pillow raises for damaged files and notes.
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
    if image.mode in {"F", "I"}:
        raise AssetError(f"{path}: holds 32 bits a pixel and channel; save it with 8 or 16")


def _rgb(image: Image.Image) -> Image.Image:
    """Convert any kind of pixels to 8 bit RGB."""
    if image.mode == "RGB":
        return image
    if image.mode.startswith("I;16"):
        levels = np.asarray(image).astype(np.uint16) >> 8
        return Image.fromarray(levels.astype(np.uint8)).convert("RGB")
    if image.has_transparency_data:
        seen = image.convert("RGBA")
        return Image.alpha_composite(Image.new("RGBA", seen.size, "white"), seen).convert("RGB")
    return image.convert("RGB")
