"""The registry of assets that can be fetched from public libraries; `registry.toml` holds the farm's own.

It names every file's address, size and checksum, so that a fetched file is exactly the one that was registered.
"""

import tomllib
from enum import StrEnum
from functools import cache
from pathlib import Path, PurePosixPath
from typing import Annotated, Self
from urllib.parse import urlsplit

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError, model_validator

from assets.files import LARGEST_FILE, Checksum
from assets.scan.texture_names import TextureRole, parse_texture_name
from assets.scan.textures import SUFFIXES
from farm.errors import AssetError

OWN_REGISTRY = Path(__file__).with_name("registry.toml")

LARGEST_ARCHIVE = 4 * 2**30
"""Largest archive that can be registered, bytes: 4 GiB, so that a wrong entry can't fill a disk."""

ARCHIVE_ENDINGS = (".tgz", ".tar.gz", ".whl", ".zip")
"""Endings of an archive's address that the farm can unpack."""

LOCAL_HOSTS = frozenset({"localhost", "127.0.0.1", "::1"})
"""Hosts whose addresses may be http, since their traffic never leaves the machine."""


def check_url(url: str) -> str:
    """Return the address if a registry may name it: https, or http on this machine, without a password.

    Raises:
        ValueError: The registry may not name this address.
    """
    parts = urlsplit(url)
    if parts.scheme != "https" and not (parts.scheme == "http" and parts.hostname in LOCAL_HOSTS):
        raise ValueError(f"{url}: must begin with https://")
    if (
        not parts.hostname
        or parts.port == 0
        or "@" in parts.netloc
        or parts.fragment
        or not url.isascii()
        or not url.isprintable()
    ):
        raise ValueError(f"{url}: isn't the plain address of a file")
    return url


Url = Annotated[str, AfterValidator(check_url)]


class Kind(StrEnum):
    """The kinds of assets that can be fetched."""

    HDRI = "hdri"
    TEXTURE = "texture"

    @property
    def folder(self) -> str:
        """Name of the folder for assets of this kind, and of the command's flag that takes such a folder."""
        return {Kind.HDRI: "hdris", Kind.TEXTURE: "textures"}[self]


class _Entry(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Archive(_Entry):
    """A published package that holds files of assets.

    Attributes:
        name: Name by which `AssetFile.archive` refers to the package.
        url: Address of the package; its ending tells tar from zip.
        sha256: SHA-256 of the package, hexadecimal.
        bytes: Size of the package in bytes.
    """

    name: str = Field(min_length=1)
    url: Url
    sha256: Checksum
    bytes: int = Field(gt=0, le=LARGEST_ARCHIVE)

    @model_validator(mode="after")
    def _check_ending(self) -> Self:
        if not urlsplit(self.url).path.endswith(ARCHIVE_ENDINGS):
            raise ValueError(f"{self.url}: must end in one of {', '.join(ARCHIVE_ENDINGS)}")
        return self


class AssetFile(_Entry):
    """One file of an asset. With both an address and an archive, the address is tried first.

    Attributes:
        file: Name of the file in the user's folder, whatever an archive calls it.
        sha256: SHA-256 of the file, hexadecimal.
        bytes: Size of the file in bytes.
        url: Address of the file by itself; None if only an archive holds it.
        archive: Name of the archive that holds the file; None if none does.
        member: Full name of the file inside that archive.
    """

    file: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,99}$")
    sha256: Checksum
    bytes: int = Field(gt=0, le=LARGEST_FILE)
    url: Url | None = None
    archive: str | None = None
    member: str | None = None

    @model_validator(mode="after")
    def _check_source(self) -> Self:
        if (self.archive is None) != (self.member is None):
            raise ValueError(f"{self.file}: archive and member go together")
        if self.url is None and self.archive is None:
            raise ValueError(f"{self.file}: give a url, or an archive and its member")
        return self


class Asset(_Entry):
    """An HDRI, or the maps of a texture.

    Attributes:
        name: Name by which users ask for the asset.
        kind: HDRI or texture.
        licence: SPDX identifier of the licence.
        author: Name of the author.
        source: Address of the page that shows the asset and states its licence.
        file: Files of the asset: one for an HDRI, one per map for a texture, with names that
            `assets.scan.texture_names` can tell apart.
    """

    name: str = Field(pattern=r"^[a-z0-9][a-z0-9_-]{0,79}$")
    kind: Kind
    licence: str = Field(min_length=1)
    author: str = Field(min_length=1)
    source: str = Field(pattern=r"^https://")
    file: tuple[AssetFile, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _check_files(self) -> Self:
        if self.kind is Kind.HDRI:
            if len(self.file) != 1 or PurePosixPath(self.file[0].file).suffix not in {".hdr", ".exr"}:
                raise ValueError(f"{self.name}: an HDRI is one file, .hdr or .exr")
            return self
        for entry in self.file:
            if PurePosixPath(entry.file).suffix not in SUFFIXES:
                raise ValueError(f"{entry.file}: isn't a kind of image that textures have")
        roles = [role_of(entry) for entry in self.file]
        if None in roles or len(set(roles)) != len(roles) or TextureRole.COLOUR not in roles:
            raise ValueError(f"{self.name}: file names must tell its maps apart, one of them '_color'")
        return self


def role_of(entry: AssetFile) -> TextureRole | None:
    """Tell from a file's name which map of a texture it holds; None if the name tells none."""
    return parse_texture_name(PurePosixPath(entry.file).stem).role


class Registry(_Entry):
    """All assets that can be fetched.

    Attributes:
        archive: Packages that hold files of assets.
        asset: Assets that users can ask for.
    """

    archive: tuple[Archive, ...] = ()
    asset: tuple[Asset, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _check_names(self) -> Self:
        archives = [archive.name for archive in self.archive]
        _refuse_twice("archive", archives)
        _refuse_twice("asset", [asset.name for asset in self.asset])
        files = [entry for asset in self.asset for entry in asset.file]
        # On some file systems Oak.png and oak.png are the same file.
        _refuse_twice(
            "file", [f"{asset.kind.folder}/{entry.file.lower()}" for asset in self.asset for entry in asset.file]
        )
        for entry in files:
            if entry.archive is not None and entry.archive not in archives:
                raise ValueError(f"{entry.file}: there is no archive '{entry.archive}'")
        return self

    def find(self, names: list[str]) -> tuple[Asset, ...]:
        """Find the assets with these names, in the registry's order; every asset if `names` is empty.

        Raises:
            AssetError: No asset has one of the names.
        """
        known = {asset.name: asset for asset in self.asset}
        for name in names:
            if name not in known:
                raise AssetError(f"{name}: no such asset is registered; there are {', '.join(known)}")
        return tuple(asset for asset in self.asset if not names or asset.name in names)


def read_registry(path: Path) -> Registry:
    """Read a registry.

    Args:
        path: Path of a TOML file in the form of `registry.toml`.

    Returns:
        The registry in the file.

    Raises:
        AssetError: The file can't be read, or a key is missing, unknown or wrong.
    """
    try:
        return Registry.model_validate(tomllib.loads(path.read_text("utf-8")))
    except OSError as error:
        raise AssetError(f"{path}: can't be read ({error.strerror}); check the file and its permissions") from error
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        problem = first["msg"].removeprefix("Value error, ")
        raise AssetError(
            f"{path}: {f'{where}: ' if where else ''}{problem}; see the farm's own, {OWN_REGISTRY}"
        ) from error
    except (ValueError, RecursionError) as error:  # tomllib also raises these, for numbers of 5,000 digits, say
        raise AssetError(f"{path}: isn't TOML ({error}); see the farm's own, {OWN_REGISTRY}") from error


@cache
def own_registry() -> Registry:
    """Read the registry that comes with the farm.

    Raises:
        AssetError: The registry is missing or wrong, so the installation is damaged.
    """
    return read_registry(OWN_REGISTRY)


def _refuse_twice(what: str, names: list[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"the {what} '{name}' is there twice")
