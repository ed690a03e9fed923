"""This machine: its unique name, the user's cache folder, its cores and its memory."""

import functools
import os
import socket
from contextlib import suppress
from pathlib import Path

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
    """Name the folder for files that can be made again: `cable-farm` below XDG_CACHE_HOME or ~/.cache."""
    cache = os.environ.get("XDG_CACHE_HOME")
    return (Path(cache) if cache else Path.home() / ".cache") / "cable-farm"


def usable_cores() -> int:
    """Count the cores that this process may run on."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def memory_bytes() -> int:
    """Measure the size of this machine's memory, in bytes."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
