"""A local folder, or one mounted on this machine."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from stat import S_ISDIR

from farm.errors import DestinationError
from farm.machine import machine_name
from farm.storage.folder_faults import folder_error, lost_link, lost_link_error
from farm.storage.port import TEMPORARY_PREFIX, StoredFile, is_temporary
from farm.storage.sync import sync_file, sync_folder

_PART_BYTES = 4 * 1024 * 1024
"""Bytes that are read of a large file at a time."""

_OF_SYSTEMS = frozenset(
    {
        *("lost+found", ".DS_Store", ".Spotlight-V100", ".fseventsd", ".Trashes", ".snapshot", ".snapshots"),
        *("System Volume Information", "$RECYCLE.BIN", "Thumbs.db", "desktop.ini", "@eaDir", "#recycle"),
    }
)
"""Names that file systems, file servers and desktops put into folders: they are no part of any dataset."""

_OF_SYSTEMS_START = (".nfs", ".fuse_hidden", "._", ".Trash-")
"""Starts of such names: what NFS and FUSE keep of a removed file that is open, and what a Mac puts beside a file."""


class LocalStorage:
    """A folder of this machine, or one mounted on it. Links are followed.

    Args:
        root: the folder.
        anchor: file of the folder without which nothing is written, and no absence is believed: a folder that lacks it
            has gone with its mount. Empty if the folder needs none.
    """

    def __init__(self, root: Path, anchor: str = "") -> None:
        self._root = root
        self._anchor = anchor

    def anchored(self, anchor: str) -> "LocalStorage":
        """Make a storage of the same folder that needs a file there; see the class's `anchor`."""
        return LocalStorage(self._root, anchor)

    @property
    def location(self) -> str:
        """The folder's path."""
        return str(self._root)

    def read(self, path: str) -> bytes:
        """Read a file; see `Storage.read`."""
        with self._translated("read", path):
            return (self._root / path).read_bytes()

    def read_parts(self, path: str) -> Iterator[bytes]:
        """Read a file in parts; see `Streams.read_parts`."""
        with self._translated("read", path), (self._root / path).open("rb") as file:
            while part := file.read(_PART_BYTES):
                yield part

    def write(self, path: str, content: bytes) -> None:
        """Write beside the target, read back, then move; see `Storage.write`.

        A target that is a link is replaced by the file; what it linked to stays as it is, as others may use it.
        """
        self.write_parts(path, [content])

    def write_parts(self, path: str, parts: Iterable[bytes]) -> int:
        """Write as `write` does, from parts; see `Streams.write_parts`."""
        target = self._root / path
        # Machine and process make the name unique among all writers of one shared folder.
        temporary = target.with_name(f"{TEMPORARY_PREFIX}{target.name}.{machine_name()}.{os.getpid()}")
        try:
            self._require_anchor("write", path)
            target.parent.mkdir(parents=True, exist_ok=True)
            if lost := lost_link(target, below=target):
                raise lost_link_error(lost, "write", target)
            try:
                written = self._write_and_check(temporary, parts)
                temporary.replace(target)
            except BaseException:
                with suppress(OSError):
                    temporary.unlink()
                raise
            # The move itself must reach the disk before a manifest, written later, can vouch for the file.
            sync_folder(target.parent)
        except OSError as error:
            raise folder_error(error, "write", target) from error
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
            sync_file(file.fileno())
        with temporary.open("rb") as file:
            if hashlib.file_digest(file, "sha256").digest() != digest.digest():
                raise DestinationError(f"{temporary}: reads back other than written; check the disk")
        return written

    def files(self, under: str = "", *, deep: bool = True) -> dict[str, StoredFile]:
        """List every file below the folder, those of linked folders too; see `Storage.files`.

        Raises:
            DestinationError: also if a link is there whose target is not.
        """
        return dict(self.scan(under, deep=deep))

    def scan(self, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
        """List the files one by one; see `Streams.scan`."""
        folder = self._root / under if under else self._root
        with suppress(FileNotFoundError), self._translated("list", under):
            try:
                yield from self._scan(folder, f"{under}/" if under else "", deep=deep)
            except NotADirectoryError:
                # A name that a file has is a folder without files; but a dataset's folders are none of files.
                if not under or self._anchor:
                    raise

    def _scan(self, folder: Path, prefix: str, *, deep: bool) -> Iterator[tuple[str, StoredFile]]:
        with os.scandir(folder) as entries:
            for entry in entries:
                if _is_of_a_system(entry.name):
                    continue
                # A file may vanish between its listing and its stat: a temporary one that was moved.
                with suppress(FileNotFoundError):
                    if entry.is_symlink():
                        yield from self._scan_link(Path(entry.path), prefix, deep=deep)
                    elif not entry.is_dir():
                        stat = entry.stat()
                        yield prefix + entry.name, StoredFile(stat.st_size, stat.st_mtime)
                    elif deep:
                        yield from self._scan(folder / entry.name, f"{prefix}{entry.name}/", deep=True)

    def _scan_link(self, link: Path, prefix: str, *, deep: bool) -> Iterator[tuple[str, StoredFile]]:
        if lost_link(link, below=link):
            # A hidden one is an editor's lock. Any other may be half of the data.
            if not link.name.startswith("."):
                raise lost_link_error(link, "list", link)
            return
        with self._translated("list", str(link.relative_to(self._root))):
            stat = link.stat()
        if not S_ISDIR(stat.st_mode):
            yield prefix + link.name, StoredFile(stat.st_size, stat.st_mtime)
        elif deep and not self._leads_back(link, stat):
            yield from self._scan(link, f"{prefix}{link.name}/", deep=True)

    def _leads_back(self, link: Path, target: os.stat_result) -> bool:
        """Whether a link's target is one of the folders through which the link was reached: it would never end."""
        above = [path for path in link.parents if path.is_relative_to(self._root)]
        return any(os.path.samestat(target, path.stat()) for path in above)

    def is_empty(self) -> bool:
        """Whether the folder holds nothing; see `Storage.is_empty`."""
        try:
            with self._translated("list", ""), os.scandir(self._root) as entries:
                return all(is_temporary(entry.name) or _is_of_a_system(entry.name) for entry in entries)
        except FileNotFoundError:
            return True

    def remove(self, path: str) -> None:
        """Remove a file, or a link to one; see `Storage.remove`."""
        with suppress(FileNotFoundError), self._translated("remove", path):
            (self._root / path).unlink()

    @contextmanager
    def _translated(self, action: str, path: str) -> Iterator[None]:
        """Turn the system's errors into the farm's, except that of a file that is truly not there."""
        place = self._root / path if path else self._root
        try:
            yield
        except FileNotFoundError:
            if lost := lost_link(place, below=self._root):
                raise lost_link_error(lost, action, place) from None
            self._require_anchor(action, path)
            raise
        except OSError as error:
            raise folder_error(error, action, place) from error

    def _require_anchor(self, action: str, path: str) -> None:
        """Raise DestinationError if the folder has lost its anchor, so that nothing in it can be judged."""
        if not self._anchor or path == self._anchor:
            return
        try:
            (self._root / self._anchor).stat()
        except (FileNotFoundError, NotADirectoryError) as error:
            raise DestinationError(
                f"{self._root}: can't {action} {path or 'it'}: its {self._anchor} is gone; is its disk mounted?"
            ) from error
        except OSError as error:
            raise folder_error(error, action, self._root / self._anchor) from error

    def create(self, path: str, content: bytes) -> bool:
        """Make a file that is not there; see `Storage.create`."""
        # Not by a link to a whole file: some file systems have no links.
        try:
            with (self._root / path).open("xb") as file:
                file.write(content)
        except FileExistsError:
            return False
        except OSError as error:
            raise DestinationError(f"{self._root / path}: can't write: {error.strerror or error}") from error
        return True


def _is_of_a_system(name: str) -> bool:
    return name in _OF_SYSTEMS or name.startswith(_OF_SYSTEMS_START)
