"""What a scan of a user's folder gives: what can be used, and each file that is left out, with the reason."""

import stat
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from farm.errors import AssetError

T = TypeVar("T")

_FOREIGN_IMAGES = frozenset(
    {".avif", ".bmp", ".cr2", ".dds", ".dng", ".exr", ".gif", ".hdr", ".heic", ".heif", ".j2k", ".jfif", ".jp2"}
    | {".jpeg", ".jpg", ".jxl", ".nef", ".png", ".psb", ".psd", ".raw", ".svg", ".tga", ".tif", ".tiff", ".webp"}
)
"""Suffixes of images of all kinds: one that a scan does not read is mentioned. Other files go without a word."""


@dataclass(frozen=True, slots=True)
class LeftOut:
    """A file that a scan does not use.

    Attributes:
        path: The file.
        message: Its path, what is wrong or why it is not used, and what to do.
        broken: Whether it can't be used although it was meant to be; False for a file that is of no use here.
    """

    path: Path
    message: str
    broken: bool


@dataclass(frozen=True, slots=True)
class Survey(Generic[T]):
    """What a folder holds.

    Attributes:
        found: What can be used, sorted by name.
        left_out: The other files, sorted by path.
    """

    found: tuple[T, ...]
    left_out: tuple[LeftOut, ...]

    def needed(self, folder: Path, kind: str) -> tuple[T, ...]:
        """Return what was found.

        Args:
            folder: The folder, for the error.
            kind: What was looked for, for the error.

        Raises:
            AssetError: Nothing was found; the message names the first file that was left out.
        """
        if self.found:
            return self.found
        reasons = sorted(self.left_out, key=lambda entry: not entry.broken)
        if not reasons:
            raise AssetError(f"{folder}: holds {kind}; put some there or leave the folder out")
        others = f" (and {len(reasons) - 1} more files)" if len(reasons) > 1 else ""
        raise AssetError(f"{folder}: holds {kind} that can be used: {reasons[0].message}{others}")


def broken(path: Path, error: AssetError | str) -> LeftOut:
    """Make the note of a file that can't be used."""
    return LeftOut(path, str(error) if isinstance(error, AssetError) else f"{path}: {error}", broken=True)


def aside(path: Path, reason: str) -> LeftOut:
    """Make the note of a file that is of no use here."""
    return LeftOut(path, f"{path}: {reason}", broken=False)


def entries_of(folder: Path, advice: str) -> list[Path]:
    """List a folder, without hidden files, sorted by name.

    Args:
        folder: The folder.
        advice: What to give instead, for the error.

    Raises:
        AssetError: It is no folder, or can't be listed.
    """
    try:
        if not folder.is_dir():
            raise AssetError(f"{folder}: isn't a folder; {advice}")
        return sorted(path for path in folder.iterdir() if not path.name.startswith("."))
    except OSError as error:
        raise AssetError(f"{folder}: can't be listed ({error.strerror}); check its permissions") from error


def mode_of(path: Path) -> int:
    """Return the kind and rights of what a path leads to (`os.stat`), or 0 if it leads nowhere that can be seen."""
    try:
        return path.stat().st_mode
    except OSError:
        return 0


def nameless(path: Path) -> str | None:
    """Say why a header can't hold a path, or None if it can: headers are UTF-8, and a file's name may be any bytes."""
    try:
        str(path.resolve()).encode()
    except UnicodeEncodeError:
        return "its path isn't UTF-8; rename the file or its folder"
    except (OSError, RuntimeError):
        return "its link leads in a circle; remove it"
    return None


def sort_out(paths: Iterable[Path], suffixes: Iterable[str], read: str) -> tuple[list[Path], list[LeftOut]]:
    """Part the files that a scan reads from those that it leaves out for their names.

    Args:
        paths: Entries of a folder.
        suffixes: Suffixes, in lower case, of the files that the scan reads.
        read: What the scan reads, for the notes.

    Returns:
        The files to read, and notes of those that are none of them: subfolders, images of other kinds, and names that
        a header can't hold.
    """
    wanted, notes, known = [], [], frozenset(suffixes)
    for path in paths:
        suffix, mode = path.suffix.lower(), mode_of(path)
        if stat.S_ISDIR(mode):
            notes.append(aside(path, "a folder in this folder isn't read; name it as well"))
        elif not stat.S_ISREG(mode):
            if suffix in known and not mode:
                notes.append(
                    broken(path, "can't be reached; restore the file that its link names, or check its rights")
                )
        elif suffix in known:
            reason = nameless(path)
            if reason is None:
                wanted.append(path)
            else:
                notes.append(broken(path, reason))
        elif suffix in _FOREIGN_IMAGES:
            notes.append(aside(path, f"isn't read; save it as {read}"))
    return wanted, notes


def names_of(paths: Iterable[Path]) -> dict[str, Path]:
    """Name files by their stems; of files that share one, the second and later ones by their whole names."""
    named: dict[str, Path] = {}
    for path in paths:
        named[path.name if path.stem in named else path.stem] = path
    return named


def survey_files(
    entries: Iterable[Path], suffixes: Iterable[str], kinds: str, read: Callable[[Path, str], T]
) -> Survey[T]:
    """Read the files of a folder that are each a thing of their own.

    Args:
        entries: Entries of the folder; see `entries_of`.
        suffixes: Suffixes, in lower case, of the files to read.
        kinds: What the suffixes mean, for the notes.
        read: Reads a file under a name of its own; raises AssetError if it can't be used.
    """
    paths, left_out = sort_out(entries, suffixes, kinds)
    found = []
    for name, path in names_of(paths).items():
        try:
            found.append(read(path, name))
        except AssetError as error:
            left_out.append(broken(path, error))
    return Survey(tuple(found), tuple(sorted(left_out, key=lambda entry: entry.path)))
