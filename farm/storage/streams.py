"""Long listings and large files, a part at a time, from storages that can do so; from others, as a whole.

A listing of a million pictures has four million files: held at once, they take more than a gigabyte.
"""

from collections.abc import Iterable, Iterator
from typing import Protocol, runtime_checkable

from farm.storage.port import Storage, StoredFile


@runtime_checkable
class Streams(Protocol):
    """What a storage may offer besides `Storage`."""

    def scan(self, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
        """Yield what `Storage.files` returns, in any order, without holding it all.

        Raises:
            DestinationError: if the folder can't be read.
        """
        ...

    def read_parts(self, path: str) -> Iterator[bytes]:
        """Yield a file's bytes in parts of a few megabytes. They are of one file only if nobody replaces it meanwhile.

        Raises:
            FileNotFoundError: if there is none.
            DestinationError: if it can't be read.
        """
        ...

    def write_parts(self, path: str, parts: Iterable[bytes]) -> int:
        """Put a file in place as `Storage.write` does, from its parts; what the iterable raises ends the write.

        Returns:
            Number of bytes written.

        Raises:
            DestinationError: as `Storage.write`.
        """
        ...


def scan(storage: Storage, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
    """List a storage's files one by one; see `Streams.scan`."""
    if isinstance(storage, Streams):
        yield from storage.scan(under, deep=deep)
    else:
        yield from storage.files(under, deep=deep).items()


def read_parts(storage: Storage, path: str) -> Iterator[bytes]:
    """Read a file in parts; see `Streams.read_parts`."""
    if isinstance(storage, Streams):
        yield from storage.read_parts(path)
    else:
        yield storage.read(path)


def write_parts(storage: Storage, path: str, parts: Iterable[bytes]) -> int:
    """Write a file from its parts; see `Streams.write_parts`."""
    if isinstance(storage, Streams):
        return storage.write_parts(path, parts)
    content = b"".join(parts)
    storage.write(path, content)
    return len(content)
