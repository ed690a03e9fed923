"""The interface of every storage."""

from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Protocol

TEMPORARY_PREFIX = ".tmp-"


@dataclass(frozen=True, slots=True)
class StoredFile:
    """A file in a listing, with its last change.

    Attributes:
        bytes: its size.
        modified_s: time of the change, in seconds of the Unix epoch; 0 where unknown.
        tag: the mark that an object store gives the content, its ETag; empty where there is none. It tells apart two
            changes within the second to which such stores tell the time.
    """

    bytes: int
    modified_s: float
    tag: str = ""


class Storage(Protocol):
    """Files by paths relative to one folder, with `/` between the parts."""

    @property
    def location(self) -> str:
        """The folder, as a person would write it."""
        ...

    def read(self, path: str) -> bytes:
        """Read a whole file.

        Raises:
            FileNotFoundError: if there is none.
            DestinationError: if it can't be read.
        """
        ...

    def write(self, path: str, content: bytes) -> None:
        """Put a whole file in place, replacing one that is there, and make sure that it is what was sent.

        Raises:
            DestinationError: if it can't be written, then the former state remains; or if the store took it and holds
                something else.
        """
        ...

    def create(self, path: str, content: bytes) -> bool:
        """Put a small file in place unless one is there; of several writers at once, one succeeds.

        Returns:
            Whether the file is this caller's. A reader may meet it half written for an instant.

        Raises:
            DestinationError: if it can't be written.
        """
        ...

    def files(self, under: str = "", *, deep: bool = True) -> dict[str, StoredFile]:
        """List every file below the folder, by path; none if the folder does not exist.

        Args:
            under: a folder in it, to list that alone; the paths stay relative to the whole.
            deep: whether to list folders in it, too.

        Raises:
            DestinationError: if the folder can't be read.
        """
        ...

    def is_empty(self) -> bool:
        """Whether the folder holds nothing but what killed writers left, or does not exist.

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
