"""What can be fetched from public libraries: a registry of files, each by its content. See `registry.toml`."""

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
"""Bytes above which an archive can't be registered."""

ARCHIVE_ENDINGS = (".tgz", ".tar.gz", ".whl", ".zip")
LOCAL_HOSTS = frozenset({"localhost", "127.0.0.1", "::1"})


def check_url(url: str) -> str:
    """An address that a registry may name: https, or http on this machine, without a password.

    Raises:
        ValueError: It is another.
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
        raise ValueError(f"{url}: isn't a plain address of a file")
    return url


Url = Annotated[str, AfterValidator(check_url)]


class Kind(StrEnum):
    """What an asset is."""

    HDRI = "hdri"
    TEXTURE = "texture"

    @property
    def folder(self) -> str:
        """Where such assets are put, below the folder for all; also the name of the flag that takes it."""
        return {Kind.HDRI: "hdris", Kind.TEXTURE: "textures"}[self]


class _Entry(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Archive(_Entry):
    """A published package that holds assets' files.

    Attributes:
        name: How files refer to it.
        url: Where it is; its ending tells tar from zip.
        sha256: Its checksum.
        bytes: Its size.
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
    """One file of an asset. Where both are given, the address is tried first, then the archive.

    Attributes:
        file: What it is called here; never what an archive calls it.
        sha256: Its checksum.
        bytes: Its size.
        url: Where it is by itself.
        archive: Which archive holds it.
        member: What it is called in there.
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
        name: What users call it.
        kind: HDRI or texture.
        licence: SPDX identifier.
        author: Who made it.
        source: Page that shows it and states its licence.
        file: One for an HDRI; for a texture one a map, named as `assets.scan.texture_names` reads them.
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
    """Which map of a texture a file is, by its name here."""
    return parse_texture_name(PurePosixPath(entry.file).stem).role


class Registry(_Entry):
    """All that can be fetched.

    Attributes:
        archive: Packages that hold files.
        asset: What users can name.
    """

    archive: tuple[Archive, ...] = ()
    asset: tuple[Asset, ...] = Field(min_length=1)

    @model_validator(mode="after")
    def _check_names(self) -> Self:
        archives = [archive.name for archive in self.archive]
        _refuse_twice("archive", archives)
        _refuse_twice("asset", [asset.name for asset in self.asset])
        files = [entry for asset in self.asset for entry in asset.file]
        # Some file systems don't tell Oak from oak.
        _refuse_twice(
            "file", [f"{asset.kind.folder}/{entry.file.lower()}" for asset in self.asset for entry in asset.file]
        )
        for entry in files:
            if entry.archive is not None and entry.archive not in archives:
                raise ValueError(f"{entry.file}: there is no archive '{entry.archive}'")
        return self

    def find(self, names: list[str]) -> tuple[Asset, ...]:
        """The assets of these names, in the registry's order; all of them if none is named.

        Raises:
            AssetError: There is no asset of a name.
        """
        known = {asset.name: asset for asset in self.asset}
        for name in names:
            if name not in known:
                raise AssetError(f"{name}: no such asset is registered; there are {', '.join(known)}")
        return tuple(asset for asset in self.asset if not names or asset.name in names)


def read_registry(path: Path) -> Registry:
    """Read a registry.

    Args:
        path: TOML, in the form of `registry.toml`.

    Returns:
        What it holds.

    Raises:
        AssetError: It can't be read, or a key is missing, unknown or wrong.
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
    except (ValueError, RecursionError) as error:  # of the TOML; besides its own error, for numbers of 5,000 digits
        raise AssetError(f"{path}: isn't TOML ({error}); see the farm's own, {OWN_REGISTRY}") from error


@cache
def own_registry() -> Registry:
    """The one that comes with the farm.

    Raises:
        AssetError: It is missing or wrong: the installation is damaged.
    """
    return read_registry(OWN_REGISTRY)


def _refuse_twice(what: str, names: list[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"the {what} '{name}' is there twice")
