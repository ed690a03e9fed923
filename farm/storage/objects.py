"""A folder of a bucket, or of any other filesystem that fsspec knows."""

import hashlib
from collections.abc import Mapping
from contextlib import suppress
from datetime import datetime
from typing import Any

from farm.errors import DestinationError
from farm.storage.connection import connect
from farm.storage.faults import as_destination_error
from farm.storage.port import StoredFile
from farm.storage.services import service_of


class ObjectStorage:
    """A folder of any fsspec filesystem, such as a bucket. May be kept across a fork."""

    def __init__(self, url: str) -> None:
        """Connect to the filesystem of a URL; nothing is read or written yet.

        Raises:
            ImportError: if the URL's filesystem needs a package that is not installed.
            ValueError: if the URL's protocol is unknown.
        """
        self._url = url
        filesystem, self._root = connect(url)
        self._location = str(filesystem.unstrip_protocol(self._root))
        self._service = service_of(url)

    @property
    def location(self) -> str:
        """The folder as a URL, without credentials."""
        return self._location

    @property
    def _filesystem(self) -> Any:
        return connect(self._url)[0]

    def _full(self, path: str) -> str:
        return f"{self._root}/{path}" if path else self._root

    def read(self, path: str) -> bytes:
        """Read an object; see `Storage.read`."""
        with as_destination_error("read", f"{self._location}/{path}"):
            return bytes(self._filesystem.cat_file(self._full(path), **self._service.get_options))

    def write(self, path: str, content: bytes) -> None:
        """Put the object at once, then ask what is there; see `Storage.write`."""
        place = f"{self._location}/{path}"
        try:
            with as_destination_error("write", place):
                self._filesystem.pipe_file(self._full(path), content, **self._service.put_options(len(content)))
                if not self._holds(path, content):
                    # It is left there: it may be the good one of another writer of the same file.
                    raise DestinationError(f"{place}: the store holds other than was sent; write it again")
        except FileNotFoundError as error:
            raise DestinationError(f"{place}: can't write: {error}; check the bucket") from error

    def create(self, path: str, content: bytes) -> bool:
        """Put an object that is not there; see `Storage.create`."""
        place, options = f"{self._location}/{path}", self._service.put_options(len(content))
        if self._is_there(path):
            return False
        try:
            with as_destination_error("write", place):
                self._filesystem.pipe_file(self._full(path), content, mode="create", **options)
        except (FileNotFoundError, DestinationError):
            if self._is_there(path):
                return False
            # The store knows no put on a condition, or it is out of order, and then this fails too.
            self.write(path, content)
        return self.read(path) == content

    def _is_there(self, path: str) -> bool:
        try:
            self.read(path)
        except FileNotFoundError:
            return False
        return True

    def _holds(self, path: str, content: bytes) -> bool:
        info = self._filesystem.info(self._full(path))
        if int(info["size"]) != len(content):
            return False
        # Most stores tell an object's MD5 by its tag, but not of one in parts or encrypted: then it is read back.
        checksum = hashlib.md5(content, usedforsecurity=False).hexdigest()
        return str(info.get("ETag")).strip('"') == checksum or self.read(path) == content

    def files(self, under: str = "", *, deep: bool = True) -> dict[str, StoredFile]:
        """List every object below the folder; see `Storage.files`."""
        folder = self._full(under)
        depth = None if deep else 1
        listing: Mapping[str, Mapping[str, Any]] = {}
        with suppress(FileNotFoundError), as_destination_error("list", f"{self._location}/{under}".rstrip("/")):
            listing = self._filesystem.find(folder, maxdepth=depth, detail=True)
        start = len(self._root) + 1
        return {
            name[start:]: StoredFile(int(info["size"]), _modified_s(info))
            for name, info in listing.items()
            if name.startswith(f"{folder}/") and not _marks_folder(name)
        }

    def is_empty(self) -> bool:
        """Whether the folder holds nothing; see `Storage.is_empty`."""
        names: list[str] = []
        with suppress(FileNotFoundError), as_destination_error("list", self._location):
            names = self._filesystem.ls(self._root, detail=False)
        return all(_marks_folder(name) for name in names)

    def remove(self, path: str) -> None:
        """Remove an object; see `Storage.remove`."""
        with suppress(FileNotFoundError), as_destination_error("remove", f"{self._location}/{path}"):
            self._filesystem.rm_file(self._full(path))


def _marks_folder(name: str) -> bool:
    # Consoles of object stores make such an object of no bytes for an empty folder.
    return name.endswith("/")


def _modified_s(info: Mapping[str, Any]) -> float:
    # Each filesystem has its own name for the same thing.
    for key in ("mtime", "LastModified", "last_modified", "updated", "created"):
        value = info.get(key)
        if isinstance(value, datetime):
            return value.timestamp()
        if isinstance(value, int | float):
            return float(value)
    return 0.0
