"""Drawing the surfaces into image files, once."""

import json
import multiprocessing
import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict

from assets.files import sha256, write_atomically
from assets.surfaces.baked import (
    FILE_NAMES,
    LARGEST_EDGE,
    RECORD_NAME,
    SMALLEST_EDGE,
    BakedSurface,
    MapRole,
    SurfaceRecord,
    load_surface,
)
from assets.surfaces.catalogue import SURFACES
from assets.surfaces.kit.maps import SurfaceMaps
from assets.surfaces.recipe import SurfaceRecipe, recipe_generator
from farm.errors import AssetError

COLOUR_QUALITY = 93
"""JPEG quality of the colour, with full chroma: no block shows in a close picture."""

ROUGHNESS_QUALITY = 92
"""JPEG quality of the roughness and of a map of metal."""


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
        names: Names of the surfaces; all of the catalogue if None.
        progress: Told each name as soon as that surface is ready.
        processes: Number of surfaces to draw at once; the number of cores if None.

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
        ready[name] = load_surface(directory, name)
    ordered = tuple(ready[recipe.name] for recipe in recipes)
    return BakedSet(directory=directory, surfaces=ordered, drawn=tuple(missing))


def _chosen(names: Iterable[str] | None) -> tuple[SurfaceRecipe, ...]:
    if names is None:
        return tuple(SURFACES.values())
    wanted = set(names)
    unknown = sorted(wanted - SURFACES.keys())
    if unknown:
        raise AssetError(f"unknown surface {unknown[0]!r}; there are {', '.join(SURFACES)}")
    return tuple(recipe for recipe in SURFACES.values() if recipe.name in wanted)


def _present(directory: Path, recipe: SurfaceRecipe, pixels: int) -> BakedSurface | None:
    """Load the surface on disk; None unless it is whole and just as a bake would draw it now."""
    try:
        surface = load_surface(directory, recipe.name)
    except AssetError:
        return None
    found = surface.record
    wanted = (recipe.family, recipe.size_m, recipe.version, pixels)
    if (found.family, found.size_m, found.recipe_version, found.pixels) != wanted:
        return None
    return surface


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
            has_joints=maps.joints is not None,
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
    if maps.joints is not None:
        yield "joints", _encode(".png", maps.joints, [cv2.IMWRITE_PNG_COMPRESSION, 6])


def _encode(ending: str, image: npt.NDArray[np.uint8], options: list[int]) -> bytes:
    done, data = cv2.imencode(ending, np.ascontiguousarray(image), options)
    if not done:
        raise AssetError(f"OpenCV can't write {ending} images; install opencv-contrib-python-headless again")
    return data.tobytes()
