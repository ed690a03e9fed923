"""This machine: its unique name, the user's own folders, its cores and its memory."""

import functools
import os
import pwd
import socket
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

from farm.errors import MachineError

_MACHINE_ID = Path("/etc/machine-id")
_PROCESSES = Path("/proc/self/ns/pid")


@functools.cache
def machine_name() -> str:
    """Name this machine: host name, machine id and pid namespace, joined by `-`; a part that can't be read is left out.

    Two machines may have the same host name, and containers may share it without seeing each other's processes.
    """
    parts = [socket.gethostname()]
    with suppress(OSError):
        parts.append(_MACHINE_ID.read_text().strip()[:12])
    with suppress(OSError):
        parts.append(str(_PROCESSES.stat().st_ino))
    return "-".join(part for part in parts if part)


def cache_folder() -> Path:
    """Name the folder for files that can be made again: `cable-farm` below XDG_CACHE_HOME or ~/.cache.

    Raises:
        MachineError: see `own_folder`.
    """
    return own_folder("XDG_CACHE_HOME", ".cache")


def state_folder() -> Path:
    """Name the folder for programs' state, such as logs: `cable-farm` below XDG_STATE_HOME or ~/.local/state.

    Raises:
        MachineError: see `own_folder`.
    """
    return own_folder("XDG_STATE_HOME", ".local/state")


def own_folder(variable: str, below_home: str) -> Path:
    """Name one of the user's folders for the farm's own files; only one in the temporary folder is made here.

    Args:
        variable: variable that names the folder's parent. One that is relative counts as not set, as the XDG Base
            Directory Specification says.
        below_home: parent's path below the home folder.

    Returns:
        `cable-farm` below what the variable names, else below the home folder, else a folder in the temporary folder
        that only this user can enter: containers and cron run users without a home, or with one that is not theirs.

    Raises:
        MachineError: if the folder in the temporary folder is another user's, or can't be made.
    """
    given = os.environ.get(variable, "")
    if Path(given).is_absolute():
        return Path(given) / "cable-farm"
    home = home_folder()
    if home is not None and _can_be_made(home / below_home / "cable-farm"):
        return home / below_home / "cable-farm"
    return _temporary_folder() / below_home.replace("/", "-").lstrip(".")


def home_folder() -> Path | None:
    """Find the user's home folder: HOME, else the entry in the list of users; None if neither is an absolute path."""
    home = os.environ.get("HOME", "")
    if not home:
        # Not Path.home(), which fails where there is no entry.
        with suppress(KeyError):
            home = pwd.getpwuid(os.getuid()).pw_dir
    return Path(home) if Path(home).is_absolute() else None


def expanded(path: str) -> Path:
    """Put the home folder in the place of a `~` at a path's beginning.

    Raises:
        MachineError: if the user has no home folder, or there is no such user.
    """
    try:
        return Path(path).expanduser()
    except RuntimeError:
        raise MachineError(f"{path}: no home folder is known for ~; set HOME, or write the path in full") from None


def _can_be_made(folder: Path) -> bool:
    """Whether a folder is there to be written, or could be made."""
    for place in (folder, *folder.parents):
        if place.exists():
            return place.is_dir() and os.access(place, os.W_OK | os.X_OK)
    return False


def _temporary_folder() -> Path:
    folder = Path(tempfile.gettempdir()) / f"cable-farm-{os.getuid()}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError as error:
        raise MachineError(
            f"{folder}: this user has no home folder, and no folder can be made here: {error.strerror}; set HOME"
        ) from error
    # Anybody can make a folder of this name first.
    if not stat.S_ISDIR(found.st_mode) or found.st_uid != os.getuid() or stat.S_IMODE(found.st_mode) & 0o022:
        raise MachineError(f"{folder}: not this user's own folder, or others can write in it; remove it, or set HOME")
    return folder


def usable_cores() -> int:
    """Count the cores that this process may run on."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def memory_bytes() -> int:
    """Measure the size of this machine's memory, in bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
