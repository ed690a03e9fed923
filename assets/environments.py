"""The farm's own environments: panoramas of rooms and yards, each rendered once on each machine."""

import zlib
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from assets.files import Checksum, read_bounded, sha256
from farm.errors import AssetError

FOLDER_NAME = "environments"
RECORD_NAME = "environment.json"
PANORAMA_NAME = "panorama.exr"

SMALLEST_WIDTH, LARGEST_WIDTH = 64, 8192
DEFAULT_WIDTH = 4096
"""Pixels around the horizon. A far picture is 40 degrees wide and shows 455 of them."""

TARGET_LUMINANCE = 0.3
"""Mean luminance over the sphere to which a panorama is scaled, scene-linear. Blender's HDRIs of the day have 0.5 to
0.94.

At 0.4, far pictures of the published style are brighter than any published one."""

BRIGHTEST = 50.0
"""Scene-linear value above which light is clipped. Only lamps and reflections of the sun are brighter."""


class EnvironmentKind(StrEnum):
    """The kind of place that a panorama shows."""

    WORKSHOP = "workshop"
    LABORATORY = "laboratory"
    STOREROOM = "storeroom"
    OFFICE = "office"
    FACTORY = "factory"
    SWITCH_ROOM = "switch_room"
    YARD = "yard"


class EnvironmentRecipe(BaseModel):
    """A recipe from which an environment is built.

    Attributes:
        name: Unique name.
        kind: Kind, which decides the builder.
        seed: Seed of everything that is drawn; an odd seed builds the kind's first variant, an even one its second.
        version: Version of the recipe, which grows with every change that would give another picture of it.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$")
    kind: EnvironmentKind
    seed: int = Field(ge=0)
    version: int = Field(ge=1)


class EnvironmentRecord(BaseModel):
    """The content of `environment.json`, the record of a rendered environment.

    Attributes:
        name: The recipe's name, also the folder's.
        kind: Kind of place that it shows.
        version: Version of the recipe that built it.
        pixels: Width of the panorama; it is half as high.
        sha256: Checksum of the panorama's file.
        mean_luminance: Mean over the sphere, scene-linear.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$")
    kind: EnvironmentKind
    version: int = Field(ge=1)
    pixels: int = Field(ge=SMALLEST_WIDTH, le=LARGEST_WIDTH)
    sha256: Checksum
    mean_luminance: float = Field(gt=0, allow_inf_nan=False)


class Environment(BaseModel):
    """An environment on disk, checked.

    Attributes:
        path: The panorama, an EXR file of linear light.
        record: The record beside the panorama.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    path: Path
    record: EnvironmentRecord


_VERSIONS: Mapping[EnvironmentKind, int] = MappingProxyType(dict.fromkeys(EnvironmentKind, 2))

ENVIRONMENTS: Mapping[str, EnvironmentRecipe] = MappingProxyType(
    {
        f"{kind}_{seed}": EnvironmentRecipe(name=f"{kind}_{seed}", kind=kind, seed=seed, version=version)
        for kind, version in _VERSIONS.items()
        for seed in (1, 2)
    }
)
"""All recipes, by name."""


_STREAM = 1
"""Part of every recipe's seed. Another number makes another room of every recipe."""


def environment_generator(recipe: EnvironmentRecipe) -> np.random.Generator:
    """Make the random generator that a recipe is built with. It depends on the recipe's kind and seed alone.

    So a new version keeps the room of the version before, apart from what was changed.
    """
    return np.random.default_rng([zlib.crc32(recipe.kind.encode()), recipe.seed, _STREAM])


def environment_directory(folder: Path, name: str) -> Path:
    """Build the path of an environment's folder.

    Args:
        folder: The folder of the baked surfaces.
        name: Name of the environment.

    Raises:
        AssetError: The name would lead out of the folder.
    """
    if name in {"", ".", ".."} or Path(name).name != name or "\0" in name:
        # A dataset's header, which may come from anybody, must not lead out of the folder.
        raise AssetError(f"{name!a} can't name an environment")
    return folder / FOLDER_NAME / name


def load_environment(folder: Path, name: str) -> Environment:
    """Find one rendered environment and check its file against its checksum.

    Args:
        folder: The folder of the baked surfaces.
        name: Name of the environment.

    Raises:
        AssetError: The environment is missing, incomplete or damaged.
    """
    directory = environment_directory(folder, name)
    record_path = directory / RECORD_NAME
    repair = "run 'farm assets build' to render it afresh"
    if not record_path.exists():
        raise AssetError(f"{folder}: the environment '{name}' is not rendered here; run `farm assets build`")
    record = read_record(record_path)
    if record.name != name:
        raise AssetError(f"{record_path}: is about {record.name!r}, not {name!r}; {repair}")
    path = directory / PANORAMA_NAME
    if not path.is_file():
        raise AssetError(f"{path}: is missing; {repair}")
    if sha256(read_bounded(path)) != record.sha256:
        raise AssetError(f"{path}: differs from its checksum in {RECORD_NAME}; {repair}")
    return Environment(path=path, record=record)


def read_record(path: Path) -> EnvironmentRecord:
    """Read an `environment.json`.

    Raises:
        AssetError: It can't be read, or isn't a valid record.
    """
    try:
        return EnvironmentRecord.model_validate_json(read_bounded(path))
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        repair = "run 'farm assets build' to render it afresh"
        raise AssetError(f"{path}: {place} {first['msg']}; {repair}") from error


def chosen_environments(names: tuple[str, ...] | None) -> tuple[EnvironmentRecipe, ...]:
    """Find the recipes with these names, or all recipes for None, in the registry's order.

    Raises:
        AssetError: A name is unknown.
    """
    if names is None:
        return tuple(ENVIRONMENTS.values())
    unknown = sorted(set(names) - ENVIRONMENTS.keys())
    if unknown:
        raise AssetError(f"unknown environment {unknown[0]!a}; there are {', '.join(ENVIRONMENTS)}")
    return tuple(recipe for recipe in ENVIRONMENTS.values() if recipe.name in names)


def missing_environments(
    folder: Path, pixels: int | None, names: tuple[str, ...] | None = None
) -> tuple[EnvironmentRecipe, ...]:
    """Find the recipes that a folder lacks: absent, damaged, or of another version or size.

    Args:
        folder: The folder of the baked surfaces.
        pixels: Width in pixels that the panoramas must have; None to accept any.
        names: Names to look for; None for all.

    Raises:
        AssetError: A name is unknown.
    """
    return tuple(recipe for recipe in chosen_environments(names) if not _is_there(folder, recipe, pixels))


def _is_there(folder: Path, recipe: EnvironmentRecipe, pixels: int | None) -> bool:
    try:
        record = load_environment(folder, recipe.name).record
    except AssetError:
        return False
    return (record.kind, record.version) == (recipe.kind, recipe.version) and pixels in {None, record.pixels}
