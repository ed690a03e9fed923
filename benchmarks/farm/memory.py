"""Memory of a process and all its descendants, from Linux's /proc."""

from collections import defaultdict
from contextlib import suppress
from pathlib import Path

_PROCESSES = Path("/proc")


def memory_mib(process: int, processes: Path = _PROCESSES) -> float | None:
    """Proportional resident memory of a process and its descendants, in which a page that several share counts once.

    Args:
        process: identifier of the process.
        processes: folder in which the system describes its processes.

    Returns:
        MiB; None on a system without `smaps_rollup`.
    """
    if not (processes / "self" / "smaps_rollup").exists():
        return None
    return sum(_share_kib(processes, number) for number in _family(processes, process)) / 1024


def _family(processes: Path, process: int) -> set[int]:
    children: dict[int, list[int]] = defaultdict(list)
    for folder in processes.iterdir():
        # A process may end while its folder is being read.
        with suppress(OSError, ValueError, IndexError):
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            children[parent].append(int(folder.name))
    family: set[int] = set()
    waiting = [process]
    while waiting:
        number = waiting.pop()
        if number not in family:
            family.add(number)
            waiting += children[number]
    return family


def _share_kib(processes: Path, process: int) -> int:
    with suppress(OSError):
        for line in (processes / str(process) / "smaps_rollup").read_text().splitlines():
            if line.startswith("Pss:"):
                return int(line.split()[1])
    return 0
