"""The baked surfaces on disk: their records, and the check of their files."""

import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from assets.files import read_bounded, sha256
from assets.surfaces.recipe import SurfaceFamily
from farm.errors import AssetError
from farm.machine import cache_folder, expanded

RECORD_NAME = "surface.json"
"""Name of the file with a surface's record, beside its maps; a surface without it counts as not baked."""

SMALLEST_EDGE, LARGEST_EDGE = 64, 8192
"""Smallest and largest number of texels along an edge."""

MapRole = Literal["colour", "normal", "roughness", "metallic", "joints"]

FILE_NAMES: Mapping[MapRole, str] = MappingProxyType(
    {
        "colour": "colour.jpg",
        # JPEG's blocks would show as dents in what a glossy floor reflects.
        "normal": "normal.png",
        "roughness": "roughness.jpg",
        "metallic": "metallic.jpg",
        "joints": "joints.png",
    }
)


class SurfaceRecord(BaseModel):
    """The content of `surface.json`, the record of a baked surface.

    Attributes:
        name: The recipe's name, also the folder's.
        family: Material of the surface.
        size_m: Edge of the square tile in metres.
        pixels: Texels along an edge.
        recipe_version: Version of the recipe that drew it.
        metallic: One value for the whole surface, 0 to 1; None where there is a map.
        has_joints: Whether there is a map of where its pieces meet.
        sha256: Checksum of each map's file.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str = Field(pattern=r"^[a-z][a-z0-9_]*$")
    family: SurfaceFamily
    size_m: float = Field(gt=0, le=10, allow_inf_nan=False)
    pixels: int = Field(ge=SMALLEST_EDGE, le=LARGEST_EDGE)
    recipe_version: int = Field(ge=1)
    metallic: float | None = Field(ge=0, le=1)
    has_joints: bool
    sha256: dict[MapRole, str]


class BakedSurface(BaseModel):
    """A surface on disk, checked.

    Attributes:
        directory: Folder that holds its files.
        record: The record beside its maps.
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
            AssetError: The surface has no such map (`metallic` and `joints` may be missing).
        """
        if role not in self.record.sha256:
            raise AssetError(f"{self.directory}: has no {role} map; use the value in its {RECORD_NAME}")
        return self.directory / FILE_NAMES[role]


def surface_directory() -> Path:
    """Choose the folder of the surfaces: FARM_ASSETS, or `cable-farm/surfaces` in the user's cache folder."""
    chosen = os.environ.get("FARM_ASSETS")
    if chosen:
        return expanded(chosen)
    return cache_folder() / "surfaces"


def load_baked(directory: Path) -> Mapping[str, BakedSurface]:
    """Find the baked surfaces in a folder and check every file against its checksum.

    Args:
        directory: A folder that `assets.surfaces.bake.bake_surfaces` has filled.

    Returns:
        Name to surface, sorted by name.

    Raises:
        AssetError: There are none, or one is incomplete or damaged.
    """
    records = sorted(directory.glob(f"*/{RECORD_NAME}"))
    if not records:
        raise AssetError(f"{directory}: no surfaces here; run 'farm assets build'")
    surfaces = {record.parent.name: load_surface(directory, record.parent.name) for record in records}
    return MappingProxyType(surfaces)


def load_surface(folder: Path, name: str) -> BakedSurface:
    """Find one baked surface and check its files against their checksums.

    Args:
        folder: A folder that `assets.surfaces.bake.bake_surfaces` has filled.
        name: The surface's name.

    Raises:
        AssetError: It is not there, incomplete or damaged.
    """
    if name in {"", ".", ".."} or Path(name).name != name:
        # A dataset's header, which may come from anybody, must not lead out of the folder.
        raise AssetError(f"{name!a} can't name a surface")
    directory = folder / name
    record_path = directory / RECORD_NAME
    repair = "run 'farm assets build' to draw it afresh"
    if not record_path.exists():
        raise AssetError(f"{folder}: the surface '{name}' is not baked here; run `farm assets build`")
    try:
        record = SurfaceRecord.model_validate_json(read_bounded(record_path))
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        raise AssetError(f"{record_path}: {place} {first['msg']}; {repair}") from error
    if record.name != name:
        raise AssetError(f"{record_path}: is about {record.name!r}, not {name!r}; {repair}")
    optional = {"metallic": record.metallic is None, "joints": record.has_joints}
    expected = {"colour", "normal", "roughness"} | {role for role, has_map in optional.items() if has_map}
    if record.sha256.keys() != expected:
        raise AssetError(f"{record_path}: lists the maps {sorted(record.sha256)}, not {sorted(expected)}; {repair}")
    for role, checksum in record.sha256.items():
        path = directory / FILE_NAMES[role]
        if not path.is_file():
            raise AssetError(f"{path}: is missing; {repair}")
        if sha256(read_bounded(path)) != checksum:
            raise AssetError(f"{path}: differs from its checksum in {RECORD_NAME}; {repair}")
    return BakedSurface(directory=directory, record=record)
