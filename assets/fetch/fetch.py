"""Fetch registered assets into a folder, each checked before it is put in place."""

import hashlib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from enum import StrEnum
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType
from typing import Self
from urllib.parse import urlsplit

from assets.fetch.archives import read_member
from assets.fetch.download import PassingError, Patience, download, no_room
from assets.fetch.registry import Archive, Asset, AssetFile, Kind, Registry, role_of
from assets.files import open_regular, sha256
from assets.scan.hdris import read_hdri
from assets.scan.textures import read_map
from farm.errors import AssetError

_PREFIX = ".fetching-"
"""Prefix of the folders that hold unfinished downloads; scans of HDRIs and textures skip folders so named."""


class Outcome(StrEnum):
    """The outcome of `Fetcher.fetch` for an asset."""

    FETCHED = "fetched"
    PRESENT = "there already"


class Fetcher:
    """Fetches assets of one registry.

    A context manager: it keeps downloaded archives until it exits, since several assets may need the same one.
    """

    def __init__(
        self, registry: Registry, root: Path, mirror: str | None = None, patience: Patience | None = None
    ) -> None:
        """Prepare to fetch; nothing is downloaded yet.

        Args:
            registry: Registry that says where the archives are.
            root: Folder that receives the folders `hdris` and `textures`.
            mirror: Address that replaces the scheme and host of every address; the paths stay. None for no mirror.
            patience: Limits on waiting for a server; the defaults of `Patience` if None.

        Raises:
            AssetError: The mirror isn't an http or https address.
        """
        self._archives = {archive.name: archive for archive in registry.archive}
        self._root = root
        self._mirror = None if mirror is None else _check_mirror(mirror)
        self._patience = patience or Patience()
        self._got: dict[str, Path] = {}
        self._silent: set[str] = set()
        self._temporary = ExitStack()

    def __enter__(self) -> Self:
        """Return the fetcher itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove the downloaded archives."""
        self._temporary.close()

    def fetch(self, asset: Asset) -> Outcome:
        """Put an asset's files in its folder.

        A file that is there already, with the registered size and checksum, stays; one that differs is replaced. All
        files are checked in a temporary folder before an atomic rename moves the first of them to its place.

        Raises:
            AssetError: A file can't be downloaded or written, differs from the registry, or isn't an image that the
                farm can use.
        """
        folder = self._root / asset.kind.folder
        missing = [entry for entry in asset.file if not is_whole(folder / entry.file, entry)]
        if not missing:
            return Outcome.PRESENT
        with _temporary_folder(folder) as temporary:
            for entry in missing:
                self._get(entry, temporary / entry.file)
                _check_image(asset.kind, entry, temporary / entry.file)
            for entry in missing:
                try:
                    (temporary / entry.file).replace(folder / entry.file)
                except OSError as error:
                    raise no_room(folder / entry.file, error) from error
        return Outcome.FETCHED

    def _get(self, entry: AssetFile, target: Path) -> None:
        ways: list[Callable[[], None]] = []
        if entry.url is not None:
            ways.append(lambda: self._download(entry, target))
        if entry.archive is not None:
            ways.append(lambda: self._unpack(entry, target))
        failures: list[str] = []
        for way in ways:
            try:
                return way()
            except AssetError as error:
                failures.append(str(error))
        raise AssetError(", and ".join(failures))

    def _download(self, entry: AssetFile, target: Path) -> None:
        url = self._place(str(entry.url))
        if entry.archive is None:
            download(url, target, entry.bytes, entry.sha256, self._patience)
            return
        # The archive is the fallback, so a server that couldn't be reached once isn't asked a second time.
        server = urlsplit(url).netloc
        if server in self._silent:
            raise AssetError(f"{url}: can't be reached")
        try:
            download(url, target, entry.bytes, entry.sha256, replace(self._patience, pauses_s=()))
        except PassingError:
            self._silent.add(server)
            raise

    def _unpack(self, entry: AssetFile, target: Path) -> None:
        archive = self._archives[str(entry.archive)]
        url = self._place(archive.url)
        data = read_member(self._get_archive(archive, url), url, str(entry.member), entry.bytes)
        if sha256(data) != entry.sha256:
            raise AssetError(
                f"{url}: {entry.member} has checksum {sha256(data)}, not {entry.sha256} as registered; "
                "it is another file and was not kept"
            )
        try:
            target.write_bytes(data)
        except OSError as error:
            raise no_room(target, error) from error

    def _get_archive(self, archive: Archive, url: str) -> Path:
        if archive.name not in self._got:
            folder = self._temporary.enter_context(_temporary_folder(self._root))
            download(url, folder / "archive", archive.bytes, archive.sha256, self._patience)
            self._got[archive.name] = folder / "archive"
        return self._got[archive.name]

    def _place(self, url: str) -> str:
        if self._mirror is None:
            return url
        parts = urlsplit(url)
        return f"{self._mirror}{parts.path}" + (f"?{parts.query}" if parts.query else "")


def is_whole(path: Path, entry: AssetFile) -> bool:
    """Whether a file exists and has the registered size and checksum."""
    try:
        if path.stat().st_size != entry.bytes:
            return False
        with open_regular(path) as file:
            return hashlib.file_digest(file, "sha256").hexdigest() == entry.sha256
    except (OSError, AssetError):
        return False


@contextmanager
def _temporary_folder(within: Path) -> Iterator[Path]:
    """Make a temporary folder inside `within`; remove it with its content at the end.

    It lies on the same file system as `within`, so an atomic rename can move a file from one to the other.
    """
    try:
        within.mkdir(parents=True, exist_ok=True)
        temporary = TemporaryDirectory(prefix=_PREFIX, dir=within, ignore_cleanup_errors=True)
    except OSError as error:
        raise no_room(within / _PREFIX, error) from error
    with temporary as name:
        yield Path(name)


def _check_image(kind: Kind, entry: AssetFile, path: Path) -> None:
    """Refuse a file that the farm can't read as an HDRI or as a texture's map, even if its checksum is right."""
    try:
        if kind is Kind.HDRI:
            read_hdri(path)
        elif (role := role_of(entry)) is not None:
            read_map(role, path)
    except AssetError as error:
        problem = str(error).removeprefix(f"{path}: ")
        raise AssetError(f"{entry.file}: came as registered, but {problem}") from error


def _check_mirror(mirror: str) -> str:
    try:
        parts = urlsplit(mirror)
        sound = parts.scheme in {"http", "https"} and parts.hostname and parts.port != 0 and "@" not in parts.netloc
    except ValueError:  # no number for a port, or half an address
        sound = False
    if not sound:
        raise AssetError(f"--mirror {mirror}: expected http(s)://HOST[:PORT][/PATH], without a password")
    return mirror.rstrip("/")
