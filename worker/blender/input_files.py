"""Finds a dataset's input files on this machine by their content: where the header says, else in folders to look in."""

import hashlib
import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from assets.files import open_regular
from farm.errors import AssetError
from farm.spec.header import FileRef

_Stamp = tuple[int, int, int, int]
"""What tells that a file is still the one that was read: device, number, bytes, time of its last change."""


class InputFiles:
    """The files that a dataset's header names, wherever they are on this machine.

    A file counts only if its SHA-256 is the header's. Each file is read once, unless it changes.

    Args:
        places: Folders, with all that is below them, and files to look in.
    """

    def __init__(self, places: Sequence[Path] = ()) -> None:
        self._places = tuple(places)
        self._checksums: dict[Path, tuple[_Stamp, str]] = {}
        self._found: dict[str, Path] = {}

    def once_checked(self, reference: FileRef) -> Path:
        """Find a file as `find` does, and take it for the same from then on, since thousands of pictures use it."""
        if reference.sha256 not in self._found:
            self._found[reference.sha256] = self.find(reference)
        return self._found[reference.sha256]

    def find(self, reference: FileRef) -> Path:
        """Find the file of a reference, and check its content.

        The header's own path is tried first, then files of the same name, then all those of the same suffix.

        Raises:
            AssetError: It is nowhere, or only with another content.
        """
        named = Path(reference.path)
        fault = ""
        try:
            if self._checksum(named) == reference.sha256:
                return named
        except AssetError as error:
            if not self._places:
                raise
            fault = str(error)
        except (OSError, ValueError) as error:  # a path with a NUL byte gives a ValueError
            fault = f"{named}: can't be read ({getattr(error, 'strerror', None) or error})"
        for path in self._candidates(named):
            try:
                if self._checksum(path) == reference.sha256:
                    return path
            except (OSError, AssetError):
                continue
        fault = fault or f"{named}: has changed since the dataset was submitted"
        looked = f"nor is it in {', '.join(map(str, self._places))}" if self._places else "no other folder was named"
        raise AssetError(
            f"{fault}; {looked}. Restore the file, or name the folder that holds it here with --inputs or FARM_INPUTS "
            f"(SHA-256 {reference.sha256[:12]}...)"
        )

    def _candidates(self, named: Path) -> Iterator[Path]:
        """Yield the files to look at: those of the same name in all places come before others of the same suffix."""
        others = []
        for path in _files_in(self._places):
            if path.name == named.name:
                yield path
            elif path.suffix.lower() == named.suffix.lower():
                others.append(path)
        yield from others

    def _checksum(self, path: Path) -> str:
        with open_regular(path) as file:
            status = os.fstat(file.fileno())
            stamp = (status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns)
            known = self._checksums.get(path)
            if known is None or known[0] != stamp:
                known = (stamp, hashlib.file_digest(file, "sha256").hexdigest())
                self._checksums[path] = known
            return known[1]


def _files_in(places: Sequence[Path]) -> Iterator[Path]:
    """Yield the files of places, in order; links to folders are followed, each folder once."""
    visited = set()
    for place in places:
        if not place.is_dir():
            yield place
            continue
        for folder, inner, names in os.walk(place, followlinks=True):
            try:
                status = Path(folder).stat()
            except OSError:
                inner.clear()
                continue
            if (status.st_dev, status.st_ino) in visited:
                inner.clear()
                continue
            visited.add((status.st_dev, status.st_ino))
            inner.sort()
            yield from (Path(folder, name) for name in sorted(names))
