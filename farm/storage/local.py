"""A local folder, or one mounted on this machine."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from farm.errors import DestinationError
from farm.machine import machine_name
from farm.storage.port import TEMPORARY_PREFIX, StoredFile, is_temporary

_PART_BYTES = 4 * 1024 * 1024
"""Bytes that are read of a large file at a time."""


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
        """Read a file; see `Storage.read`."""
        with _as_destination_error("read", str(self._root / path)):
            return (self._root / path).read_bytes()

    def read_parts(self, path: str) -> Iterator[bytes]:
        """Read a file in parts; see `Streams.read_parts`."""
        with _as_destination_error("read", str(self._root / path)), (self._root / path).open("rb") as file:
            while part := file.read(_PART_BYTES):
                yield part

    def write(self, path: str, content: bytes) -> None:
        """Write beside the target, read back, then move; see `Storage.write`."""
        self.write_parts(path, [content])

    def write_parts(self, path: str, parts: Iterable[bytes]) -> int:
        """Write as `write` does, from parts; see `Streams.write_parts`."""
        target = self._root / path
        # Machine and process make the name unique among all writers of one shared folder.
        temporary = target.with_name(f"{TEMPORARY_PREFIX}{target.name}.{machine_name()}.{os.getpid()}")
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            try:
                written = self._write_and_check(temporary, parts)
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
        return written

    @staticmethod
    def _write_and_check(temporary: Path, parts: Iterable[bytes]) -> int:
        digest, written = hashlib.sha256(), 0
        with temporary.open("wb") as file:
            for part in parts:
                file.write(part)
                digest.update(part)
                written += len(part)
            file.flush()
            os.fsync(file.fileno())
        with temporary.open("rb") as file:
            if hashlib.file_digest(file, "sha256").digest() != digest.digest():
                raise DestinationError(f"{temporary}: reads back other than written; check the disk")
        return written

    def files(self, under: str = "", *, deep: bool = True) -> dict[str, StoredFile]:
        """List every file below the folder; see `Storage.files`."""
        return dict(self.scan(under, deep=deep))

    def scan(self, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
        """List the files one by one; see `Streams.scan`."""
        folder = self._root / under
        with _as_destination_error("list", str(folder)), suppress(FileNotFoundError):
            if not under:
                yield from self._scan(folder, "", deep=deep)
            elif folder.is_dir():
                yield from self._scan(folder, f"{under}/", deep=deep)

    def _scan(self, folder: Path, prefix: str, *, deep: bool) -> Iterator[tuple[str, StoredFile]]:
        with os.scandir(folder) as entries:
            for entry in entries:
                # A file may vanish between its listing and its stat: a temporary one that was moved.
                with suppress(FileNotFoundError):
                    if entry.is_dir(follow_symlinks=False):
                        if deep:
                            yield from self._scan(folder / entry.name, f"{prefix}{entry.name}/", deep=True)
                    else:
                        stat = entry.stat()
                        yield prefix + entry.name, StoredFile(stat.st_size, stat.st_mtime)

    def is_empty(self) -> bool:
        """Whether the folder holds nothing; see `Storage.is_empty`."""
        with _as_destination_error("list", str(self._root)):
            try:
                with os.scandir(self._root) as entries:
                    return all(is_temporary(entry.name) for entry in entries)
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
