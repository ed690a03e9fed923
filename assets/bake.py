"""Drawing the surfaces into image files, once, and finding them again."""

import json
import multiprocessing
import os
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from types import MappingProxyType
from typing import Literal

import cv2
import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from assets.files import read_bounded, sha256, write_atomically
from assets.surfaces.catalogue import SURFACES
from assets.surfaces.maps import SurfaceMaps
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe
from farm.errors import AssetError
from farm.machine import cache_folder

RECORD_NAME = "surface.json"
SMALLEST_EDGE, LARGEST_EDGE = 64, 8192
COLOUR_QUALITY = 93
ROUGHNESS_QUALITY = 92

MapRole = Literal["colour", "normal", "roughness", "metallic"]

FILE_NAMES: Mapping[MapRole, str] = MappingProxyType(
    {
        "colour": "colour.jpg",
        # JPEG's blocks would show as dents in what a glossy floor reflects.
        "normal": "normal.png",
        "roughness": "roughness.jpg",
        "metallic": "metallic.jpg",
    }
)


class SurfaceRecord(BaseModel):
    """What `surface.json` says about a baked surface.

    Attributes:
        name: The recipe's name, also the folder's.
        family: What the surface is made of.
        size_m: Edge of the square tile in metres.
        pixels: Texels along an edge.
        recipe_version: Version of the recipe that drew it.
        metallic: One value for the whole surface, 0 to 1; None where there is a map.
        sha256: Checksum of each map's file.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$")
    family: SurfaceFamily
    size_m: float = Field(gt=0, le=10, allow_inf_nan=False)
    pixels: int = Field(ge=SMALLEST_EDGE, le=LARGEST_EDGE)
    recipe_version: int = Field(ge=1)
    metallic: float | None = Field(ge=0, le=1)
    sha256: dict[MapRole, str]


class BakedSurface(BaseModel):
    """A surface on disk, checked.

    Attributes:
        directory: Folder that holds its files.
        record: What is known of it.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    directory: Path
    record: SurfaceRecord

    def path(self, role: MapRole) -> Path:
        """File of a map.

        Args:
            role: Which map.

        Returns:
            Its path.

        Raises:
            AssetError: The surface has no such map (only `metallic` may be missing).
        """
        if role not in self.record.sha256:
            raise AssetError(f"{self.directory}: has no {role} map; use the value in its {RECORD_NAME}")
        return self.directory / FILE_NAMES[role]


class BakedSet(BaseModel):
    """The outcome of a bake.

    Attributes:
        directory: Folder with a folder for each surface.
        surfaces: Every surface asked for, in the catalogue's order.
        drawn: Names of those that were drawn now; the others were there already.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    directory: Path
    surfaces: tuple[BakedSurface, ...]
    drawn: tuple[str, ...]


def surface_directory() -> Path:
    """Where surfaces are kept: FARM_ASSETS, or `cable-farm/surfaces` in the user's cache folder."""
    chosen = os.environ.get("FARM_ASSETS")
    if chosen:
        return Path(chosen).expanduser()
    return cache_folder() / "surfaces"


def bake_surfaces(
    directory: Path,
    *,
    pixels: int = 2048,
    names: Iterable[str] | None = None,
    progress: Callable[[str], None] | None = None,
    processes: int | None = None,
) -> BakedSet:
    """Draw surfaces into `directory`, except those that are there already, whole and of the right version.

    Two bakes may run at once: each file is replaced in one step, and both write the same bytes.

    Args:
        directory: Gets a folder for each surface; made if missing.
        pixels: Texels along an edge, 64 to 8192.
        names: Which surfaces; all of the catalogue if None.
        progress: Told each name as soon as that surface is ready.
        processes: How many to draw at once; the number of cores if None.

    Returns:
        The surfaces asked for.

    Raises:
        AssetError: A name is unknown, `pixels` is out of range, or the folder can't be written.
    """
    if not SMALLEST_EDGE <= pixels <= LARGEST_EDGE:
        raise AssetError(f"pixels: {pixels} is outside {SMALLEST_EDGE} to {LARGEST_EDGE}; try 2048")
    recipes = _chosen(names)
    ready: dict[str, BakedSurface] = {}
    for recipe in recipes:
        present = _present(directory, recipe, pixels)
        if present is not None:
            ready[recipe.name] = present
            if progress is not None:
                progress(recipe.name)
    missing = [recipe.name for recipe in recipes if recipe.name not in ready]
    for name in _bake_all(directory, missing, pixels, processes or os.cpu_count() or 1):
        if progress is not None:
            progress(name)
    for name in missing:
        ready[name] = _load(directory / name)
    ordered = tuple(ready[recipe.name] for recipe in recipes)
    return BakedSet(directory=directory, surfaces=ordered, drawn=tuple(missing))


def load_baked(directory: Path) -> Mapping[str, BakedSurface]:
    """Find the baked surfaces in a folder and check every file against its checksum.

    Args:
        directory: A folder that `bake_surfaces` has filled.

    Returns:
        Name to surface, sorted by name.

    Raises:
        AssetError: There are none, or one is incomplete or damaged.
    """
    records = sorted(directory.glob(f"*/{RECORD_NAME}"))
    if not records:
        raise AssetError(f"{directory}: no surfaces here; run 'farm assets build'")
    surfaces = {record.parent.name: _load(record.parent) for record in records}
    return MappingProxyType(surfaces)


def recipe_generator(recipe: SurfaceRecipe) -> np.random.Generator:
    """The random generator that a recipe is baked with: it follows from the name and version alone."""
    return np.random.default_rng([zlib.crc32(recipe.name.encode()), recipe.version])


def _chosen(names: Iterable[str] | None) -> tuple[SurfaceRecipe, ...]:
    if names is None:
        return tuple(SURFACES.values())
    wanted = set(names)
    unknown = sorted(wanted - SURFACES.keys())
    if unknown:
        raise AssetError(f"unknown surface {unknown[0]!r}; there are {', '.join(SURFACES)}")
    return tuple(recipe for recipe in SURFACES.values() if recipe.name in wanted)


def _present(directory: Path, recipe: SurfaceRecipe, pixels: int) -> BakedSurface | None:
    """The surface on disk, or None unless it is whole and just as a bake would draw it now."""
    try:
        surface = _load(directory / recipe.name)
    except AssetError:
        return None
    found = surface.record
    wanted = (recipe.family, recipe.size_m, recipe.version, pixels)
    if (found.family, found.size_m, found.recipe_version, found.pixels) != wanted:
        return None
    return surface


def _load(directory: Path) -> BakedSurface:
    record_path = directory / RECORD_NAME
    repair = "run 'farm assets build' to draw it afresh"
    try:
        record = SurfaceRecord.model_validate_json(read_bounded(record_path))
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        raise AssetError(f"{record_path}: {place} {first['msg']}; {repair}") from error
    if record.name != directory.name:
        raise AssetError(f"{record_path}: is about {record.name!r}, not {directory.name!r}; {repair}")
    expected = {"colour", "normal", "roughness"} | ({"metallic"} if record.metallic is None else set())
    if record.sha256.keys() != expected:
        raise AssetError(f"{record_path}: lists the maps {sorted(record.sha256)}, not {sorted(expected)}; {repair}")
    for role, checksum in record.sha256.items():
        path = directory / FILE_NAMES[role]
        if not path.is_file():
            raise AssetError(f"{path}: is missing; {repair}")
        if sha256(read_bounded(path)) != checksum:
            raise AssetError(f"{path}: differs from its checksum in {RECORD_NAME}; {repair}")
    return BakedSurface(directory=directory, record=record)


def _bake_all(directory: Path, names: list[str], pixels: int, processes: int) -> Iterator[str]:
    if processes == 1 or len(names) <= 1:
        for name in names:
            _bake_one(directory, name, pixels)
            yield name
        return
    # Spawned, not forked: a fork may copy a lock that a thread of the caller holds.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(processes, len(names)), mp_context=context, initializer=_one_thread) as pool:
        jobs = {pool.submit(_bake_one, directory, name, pixels): name for name in names}
        try:
            for job in as_completed(jobs):
                job.result()
                yield jobs[job]
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def _one_thread() -> None:
    """Leave the other cores to the other processes."""
    cv2.setNumThreads(1)


def _bake_one(directory: Path, name: str, pixels: int) -> None:
    recipe = SURFACES[name]
    maps = recipe.build(recipe_generator(recipe), pixels)
    folder = directory / name
    try:
        folder.mkdir(parents=True, exist_ok=True)
        checksums: dict[MapRole, str] = {}
        for role, data in _encoded(maps):
            write_atomically(folder / FILE_NAMES[role], data)
            checksums[role] = sha256(data)
        record = SurfaceRecord(
            name=name,
            family=recipe.family,
            size_m=recipe.size_m,
            pixels=pixels,
            recipe_version=recipe.version,
            metallic=maps.metallic if isinstance(maps.metallic, float) else None,
            sha256=checksums,
        )
        # Written last: a surface without its record counts as not baked.
        text = json.dumps(record.model_dump(mode="json"), indent=2) + "\n"
        write_atomically(folder / RECORD_NAME, text.encode())
    except OSError as error:
        raise AssetError(f"{folder}: can't be written ({error.strerror}); choose another folder") from error


def _encoded(maps: SurfaceMaps) -> Iterator[tuple[MapRole, bytes]]:
    full_chroma = [cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]
    quality = cv2.IMWRITE_JPEG_QUALITY
    yield "colour", _encode(".jpg", maps.colour[..., ::-1], [quality, COLOUR_QUALITY, *full_chroma])
    yield "normal", _encode(".png", maps.normal[..., ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 6])
    yield "roughness", _encode(".jpg", maps.roughness, [quality, ROUGHNESS_QUALITY])
    if isinstance(maps.metallic, np.ndarray):
        yield "metallic", _encode(".jpg", maps.metallic, [quality, ROUGHNESS_QUALITY])


def _encode(ending: str, image: npt.NDArray[np.uint8], options: list[int]) -> bytes:
    done, data = cv2.imencode(ending, np.ascontiguousarray(image), options)
    if not done:
        raise AssetError(f"OpenCV can't write {ending} images; install opencv-contrib-python-headless afresh")
    return data.tobytes()
