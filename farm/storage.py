"""Where a dataset's files lie: a local folder, or any filesystem that fsspec knows by its URL.

A reader never sees half a file. A local folder gets a temporary file beside the target, which is flushed, read back
and moved into place; an object store gets each object in one put. What a killed writer leaves behind has a name that
starts with `TEMPORARY_PREFIX` and counts for nothing.
"""

import hashlib
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PurePosixPath
from typing import Any, Protocol

import fsspec

from farm.errors import DestinationError, EnvironmentMissingError
from farm.machine import machine_name

TEMPORARY_PREFIX = ".tmp-"


@dataclass(frozen=True, slots=True)
class StoredFile:
    """What a listing tells about a file; `modified_s` counts seconds of the Unix epoch, 0 where unknown."""

    bytes: int
    modified_s: float


class Storage(Protocol):
    """Files by paths relative to one folder, with `/` between the parts."""

    @property
    def location(self) -> str:
        """The folder, as a person would write it."""
        ...

    def read(self, path: str) -> bytes:
        """The content of a file.

        Raises:
            FileNotFoundError: if there is none.
            DestinationError: if it can't be read.
        """
        ...

    def write(self, path: str, content: bytes) -> None:
        """Put a whole file in place, replacing one that is there.

        Raises:
            DestinationError: if it can't be written; then the former state remains.
        """
        ...

    def files(self, under: str = "") -> dict[str, StoredFile]:
        """Every file below the folder, or below one in it, by path from the root; none where there is no folder.

        Raises:
            DestinationError: if the folder can't be read.
        """
        ...

    def is_empty(self) -> bool:
        """Whether the folder holds nothing or does not exist.

        Raises:
            DestinationError: if the folder can't be read.
        """
        ...

    def remove(self, path: str) -> None:
        """Remove a file; one that is gone already is no error.

        Raises:
            DestinationError: if it can't be removed.
        """
        ...


def is_temporary(path: str) -> bool:
    """Whether a path is that of a file still being written, or left by a killed writer."""
    return PurePosixPath(path).name.startswith(TEMPORARY_PREFIX)


@contextmanager
def _as_destination_error(action: str, place: str) -> Iterator[None]:
    try:
        yield
    except FileNotFoundError:
        raise
    except OSError as error:
        raise DestinationError(f"{place}: can't {action}: {error.strerror or error}") from error


class LocalStorage:
    """A folder of this machine, or one mounted on it."""

    def __init__(self, root: Path) -> None:
        self._root = root

    @property
    def location(self) -> str:
        """The folder's path."""
        return str(self._root)

    def read(self, path: str) -> bytes:
        """The content of a file; see `Storage.read`."""
        with _as_destination_error("read", str(self._root / path)):
            return (self._root / path).read_bytes()

    def write(self, path: str, content: bytes) -> None:
        """Write beside the target, read back, then move; see `Storage.write`."""
        target = self._root / path
        # Machine and process make the name unique among all writers of one shared folder.
        temporary = target.with_name(f"{TEMPORARY_PREFIX}{target.name}.{machine_name()}.{os.getpid()}")
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            try:
                self._write_and_check(temporary, content)
                temporary.replace(target)
            except BaseException:
                with suppress(OSError):
                    temporary.unlink()
                raise
            _sync_folder(target.parent)
        except OSError as error:
            raise DestinationError(
                f"{target}: can't write: {error.strerror or error}; check the folder's permissions and free space"
            ) from error

    @staticmethod
    def _write_and_check(temporary: Path, content: bytes) -> None:
        with temporary.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if hashlib.sha256(temporary.read_bytes()).digest() != hashlib.sha256(content).digest():
            raise DestinationError(f"{temporary}: reads back other than written; check the disk")

    def files(self, under: str = "") -> dict[str, StoredFile]:
        """Every file below the folder; see `Storage.files`."""
        found: dict[str, StoredFile] = {}
        with _as_destination_error("list", str(self._root)), suppress(FileNotFoundError):
            self._collect(self._root / under, f"{under}/" if under else "", found)
        return found

    def _collect(self, folder: Path, prefix: str, found: dict[str, StoredFile]) -> None:
        with os.scandir(folder) as entries:
            for entry in entries:
                # A file may vanish between its listing and its stat: a temporary one that was moved.
                with suppress(FileNotFoundError):
                    if entry.is_dir(follow_symlinks=False):
                        self._collect(folder / entry.name, f"{prefix}{entry.name}/", found)
                    else:
                        stat = entry.stat()
                        found[prefix + entry.name] = StoredFile(stat.st_size, stat.st_mtime)

    def is_empty(self) -> bool:
        """Whether the folder holds nothing; see `Storage.is_empty`."""
        with _as_destination_error("list", str(self._root)):
            try:
                with os.scandir(self._root) as entries:
                    return next(entries, None) is None
            except FileNotFoundError:
                return True

    def remove(self, path: str) -> None:
        """Remove a file; see `Storage.remove`."""
        with _as_destination_error("remove", str(self._root / path)):
            (self._root / path).unlink(missing_ok=True)


def _sync_folder(folder: Path) -> None:
    # The move itself must reach the disk before a manifest, written later, can vouch for the file.
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


class ObjectStorage:
    """A folder of any fsspec filesystem: a bucket, or `memory://` for tests."""

    def __init__(self, filesystem: Any, root: str) -> None:
        self._filesystem = filesystem
        self._root = root.rstrip("/")

    @property
    def location(self) -> str:
        """The folder as a URL, without credentials."""
        return str(self._filesystem.unstrip_protocol(self._root))

    def _full(self, path: str) -> str:
        return f"{self._root}/{path}"

    def read(self, path: str) -> bytes:
        """The content of an object; see `Storage.read`."""
        with _as_destination_error("read", f"{self.location}/{path}"):
            return bytes(self._filesystem.cat_file(self._full(path)))

    def write(self, path: str, content: bytes) -> None:
        """Put the object at once; see `Storage.write`."""
        try:
            self._filesystem.pipe_file(self._full(path), content)
        except OSError as error:
            raise DestinationError(
                f"{self.location}/{path}: can't write: {error}; check the bucket's rights"
            ) from error

    def files(self, under: str = "") -> dict[str, StoredFile]:
        """Every object below the folder; see `Storage.files`."""
        with _as_destination_error("list", self.location):
            self._filesystem.invalidate_cache()
            try:
                listing = self._filesystem.find(self._full(under).rstrip("/"), detail=True)
            except FileNotFoundError:
                return {}
        start = len(self._root) + 1
        return {name[start:]: StoredFile(int(info["size"]), _modified_s(info)) for name, info in listing.items()}

    def is_empty(self) -> bool:
        """Whether the folder holds nothing; see `Storage.is_empty`."""
        with _as_destination_error("list", self.location):
            self._filesystem.invalidate_cache()
            try:
                return not self._filesystem.ls(self._root, detail=False)
            except FileNotFoundError:
                return True

    def remove(self, path: str) -> None:
        """Remove an object; see `Storage.remove`."""
        with _as_destination_error("remove", f"{self.location}/{path}"), suppress(FileNotFoundError):
            self._filesystem.rm_file(self._full(path))


def _modified_s(info: dict[str, Any]) -> float:
    # Each filesystem has its own name for the same thing.
    for key in ("mtime", "LastModified", "last_modified", "updated", "created"):
        value = info.get(key)
        if isinstance(value, datetime):
            return value.timestamp()
        if isinstance(value, int | float):
            return float(value)
    return 0.0


def open_storage(location: str) -> Storage:
    """The storage at a folder's path or URL; nothing is read or written yet.

    Raises:
        EnvironmentMissingError: if the URL's filesystem needs a package that is not installed.
        DestinationError: if the URL's protocol is unknown.
    """
    if "://" not in location:
        return LocalStorage(Path(location))
    if location.startswith("file://"):
        return LocalStorage(Path(location.removeprefix("file://")))
    protocol = location.partition("://")[0]
    try:
        filesystem, root = fsspec.core.url_to_fs(location)
    except ImportError as error:
        raise EnvironmentMissingError(f"{protocol}://: {error}") from error
    except ValueError as error:
        raise DestinationError(f"{protocol}://: no such kind of storage; see fsspec's list of protocols") from error
    return ObjectStorage(filesystem, root)
