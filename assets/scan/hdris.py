"""High dynamic range surroundings: the eight that come with Blender, and the user's own."""

import importlib.util
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from assets.colour import REC709_LUMINANCE
from assets.files import Checksum, read_bounded, sha256
from assets.scan.float_image import FLOAT_SUFFIXES, read_float_image
from assets.scan.survey import Survey, entries_of, survey_files
from farm.errors import AssetError

REGISTRY_PATH = Path(__file__).with_name("hdris.toml")

DARK_BELOW = 0.25
"""Mean luminance over the sphere below which surroundings count as dark, scene-linear: a white sheet in full light has
about 1. Blender's night has 0.17, its sunset 0.49."""

BACKDROP_ABOVE = 0.02
"""Result of `horizon_luminance` above which surroundings can stand behind cables, scene-linear. Blender's night has
0.04; its studio, a black room with lamps, has 0.007 and would give black pictures."""

NEGATIVE_TOLERANCE = 0.05
"""Largest distance of a value below 0, relative to the mean luminance: lossy compression rings round bright lamps."""

ASPECT_TOLERANCE = 0.02
"""Largest difference of width / height from 2, the ratio of an equirectangular panorama."""


class Hdri(BaseModel):
    """Surroundings that passed every check.

    Attributes:
        name: Unique within its folder or registry.
        path: The file.
        sha256: Its checksum.
        dark: Whether its mean luminance is below `DARK_BELOW`.
        backdrop: Whether it can stand behind cables: its horizon is brighter than `BACKDROP_ABOVE`.
        mean_luminance: Mean luminance over the sphere, scene-linear.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    path: Path
    sha256: Checksum
    dark: bool
    backdrop: bool
    mean_luminance: float = Field(gt=0, allow_inf_nan=False)


class RegistryEntry(BaseModel):
    """An entry of `hdris.toml`: one of Blender's HDRIs.

    Attributes:
        name: Short name.
        file: File name in Blender's folder.
        sha256: Its checksum.
        licence: SPDX identifier.
        author: Name of its author.
        source: Page of the original.
        source_certain: False where Blender's own note says "probably".
        dark: Whether its mean luminance is below `DARK_BELOW`.
        backdrop: Whether it can stand behind cables: its horizon is brighter than `BACKDROP_ABOVE`.
        mean_luminance: Mean luminance over the sphere, scene-linear.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z]+$")
    file: str = Field(pattern=r"^[a-z]+\.exr$")
    sha256: Checksum
    licence: str
    author: str
    source: str = Field(pattern=r"^https://")
    source_certain: bool
    dark: bool
    backdrop: bool
    mean_luminance: float = Field(gt=0, allow_inf_nan=False)


class _Registry(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")

    hdri: tuple[RegistryEntry, ...]


@cache
def registry() -> tuple[RegistryEntry, ...]:
    """Read the list of the HDRIs that come with Blender, from `hdris.toml`.

    Returns:
        The entries in the file's order.

    Raises:
        AssetError: The file is missing or wrong: the installation is damaged.
    """
    try:
        return _Registry.model_validate(tomllib.loads(REGISTRY_PATH.read_text("utf-8"))).hdri
    except (OSError, tomllib.TOMLDecodeError, ValidationError) as error:
        raise AssetError(f"{REGISTRY_PATH}: can't be used ({error}); install the farm afresh") from error


def world_directory() -> Path:
    """Find the folder of Blender's HDRIs within the installed bpy package, without importing it.

    Returns:
        The folder.

    Raises:
        AssetError: bpy isn't installed, or has no such folder.
    """
    spec = importlib.util.find_spec("bpy")
    if spec is None or spec.origin is None:
        raise AssetError("bpy: not installed, so Blender's own HDRIs are missing; pip install 'cable-farm[worker]'")
    found = sorted(Path(spec.origin).parent.glob("*/datafiles/studiolights/world"))
    if not found:
        raise AssetError(f"{Path(spec.origin).parent}: has no datafiles/studiolights/world; install bpy 4.5 afresh")
    return found[-1]


def builtin_hdris() -> tuple[Hdri, ...]:
    """Find Blender's own HDRIs, each checked against the registry's checksum (which stands for a full decode).

    Returns:
        All of them, in the registry's order.

    Raises:
        AssetError: bpy isn't installed, or a file is missing or differs.
    """
    folder = world_directory()
    return tuple(_builtin(folder / entry.file, entry) for entry in registry())


def survey_hdris(folder: Path) -> Survey[Hdri]:
    """Read every .hdr and .exr file in a folder.

    Args:
        folder: Its subfolders aren't read.

    Returns:
        The HDRIs, each with a name of its own, and the files that `read_hdri` refuses.

    Raises:
        AssetError: It is no folder, or can't be listed.
    """
    entries = entries_of(folder, "give the folder that holds your .hdr or .exr files")
    return survey_files(entries, FLOAT_SUFFIXES, ".hdr or .exr, with high dynamic range", read_hdri)


def scan_hdris(folder: Path) -> tuple[Hdri, ...]:
    """Read the HDRIs of a folder; see `survey_hdris`.

    Returns:
        The HDRIs, sorted by name.

    Raises:
        AssetError: There is none that can be used.
    """
    return survey_hdris(folder).needed(folder, "no .hdr or .exr file")


def read_hdri(path: Path, name: str | None = None) -> Hdri:
    """Decode a file completely and check that it can light a scene.

    Args:
        path: A Radiance .hdr or OpenEXR .exr file.
        name: Name of the HDRI; None for the file's own without suffix.

    Returns:
        The HDRI, as measured.

    Raises:
        AssetError: It is truncated or damaged, isn't about twice as wide as high, or holds values that are not
            finite, negative, or all zero.
    """
    data = read_bounded(path)
    pixels = read_float_image(path)
    height, width = pixels.shape[:2]
    if abs(width / height - 2.0) > ASPECT_TOLERANCE:
        raise AssetError(f"{path}: {width} x {height} isn't 2:1; export it as an equirectangular panorama")
    if not np.isfinite(pixels).all():
        raise AssetError(f"{path}: holds infinite or undefined values; export it again with finite ones")
    mean = mean_luminance(pixels)
    if mean <= 0:
        raise AssetError(f"{path}: is black all over and can't light anything; use another")
    lowest = float(pixels.min())
    if lowest < -NEGATIVE_TOLERANCE * mean:
        raise AssetError(f"{path}: holds negative light ({lowest:.4g}); export it again, clamped at 0")
    return Hdri(
        name=name or path.stem,
        path=path,
        sha256=sha256(data),
        dark=mean < DARK_BELOW,
        backdrop=horizon_luminance(pixels) > BACKDROP_ABOVE,
        mean_luminance=mean,
    )


def horizon_luminance(pixels: npt.NDArray[np.float32]) -> float:
    """Compute the geometric mean of the luminance within 30 degrees of the horizon, which backgrounds show.

    The arithmetic mean would be that of a few lamps.

    Args:
        pixels: Equirectangular, shape (height, width, 3), linear, channels red green blue.

    Returns:
        Scene-linear luminance; values below 1e-4 count as that.
    """
    rows = len(pixels)
    luminance = pixels[rows // 3 : rows - rows // 3] @ REC709_LUMINANCE
    return float(np.exp(np.log(np.maximum(luminance, 1e-4)).mean()))


def mean_luminance(pixels: npt.NDArray[np.float32]) -> float:
    """Compute the mean luminance of a panorama over the sphere.

    Args:
        pixels: Equirectangular, shape (height, width, 3), linear, channels red green blue.

    Returns:
        Scene-linear luminance; each row counts by the solid angle that it covers.
    """
    rows = (pixels.astype(np.float64) @ REC709_LUMINANCE).mean(axis=1)
    weights = np.sin((np.arange(len(rows)) + 0.5) * np.pi / len(rows))
    return float(np.average(rows, weights=weights))


def _builtin(path: Path, entry: RegistryEntry) -> Hdri:
    if not path.is_file():
        raise AssetError(f"{path}: is missing; install bpy 4.5 afresh")
    checksum = sha256(read_bounded(path))
    if checksum != entry.sha256:
        raise AssetError(f"{path}: differs from the registry's checksum; install bpy 4.5 afresh")
    return Hdri(
        name=entry.name,
        path=path,
        sha256=checksum,
        dark=entry.dark,
        backdrop=entry.backdrop,
        mean_luminance=entry.mean_luminance,
    )
