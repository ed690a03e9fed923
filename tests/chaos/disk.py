"""A small disk in memory for a store, which can be filled up for real."""

import errno
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_FILLER = ".filler"
_BLOCK = bytes(64 * 1024)
_PAGE = bytes(4096)


class SmallDisk:
    """A mounted folder that can be filled up.

    Args:
        folder: mount point of the disk.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._filler = folder / _FILLER

    @property
    def is_full(self) -> bool:
        """Whether the disk was filled up and not freed."""
        return self._filler.exists()

    def fill(self) -> None:
        """Take all free space."""
        with self._filler.open("wb", buffering=0) as file:
            # The last pages are taken one by one; otherwise a small file would still fit.
            for piece in (_BLOCK, _PAGE):
                _write_until_full(file.fileno(), piece)

    def free(self) -> None:
        """Give the space back."""
        self._filler.unlink(missing_ok=True)


def _write_until_full(descriptor: int, piece: bytes) -> None:
    while True:
        try:
            if os.write(descriptor, piece) < len(piece):
                return
        except OSError as error:
            if error.errno != errno.ENOSPC:
                raise
            return


@contextmanager
def small_disk(folder: Path, mebibytes: int) -> Iterator[SmallDisk | str]:
    """Mount a disk in a folder within the context.

    Yields:
        The disk; or the reason why there is none, if this user may not mount one.
    """
    why_not = _mount(folder, mebibytes)
    if why_not is not None:
        yield why_not
        return
    try:
        yield SmallDisk(folder)
    finally:
        # The mount goes lazily: a process that was just killed may still be closing a file.
        subprocess.run([_program("umount"), "--lazy", str(folder)], check=True, stdin=subprocess.DEVNULL)


def _mount(folder: Path, mebibytes: int) -> str | None:
    mount = shutil.which("mount")
    if os.geteuid() != 0 or mount is None:
        return "mounting a small disk needs root"
    command = [mount, "-t", "tmpfs", "-o", f"size={mebibytes}m,mode=0700", "chaos", str(folder)]
    mounted = subprocess.run(command, check=False, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    return None if mounted.returncode == 0 else f"mounting a small disk failed: {mounted.stderr.strip()}"


def _program(name: str) -> str:
    found = shutil.which(name)
    assert found is not None, f"no {name} on PATH, though there is mount"
    return found
