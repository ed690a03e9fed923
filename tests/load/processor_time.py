"""CPU time of processes and their descendants, as Linux counts it."""

from collections.abc import Iterable
from contextlib import suppress

import psutil


def processor_s(processes: Iterable[int]) -> float:
    """User and system seconds of processes, of their living descendants, and of those that these have waited for."""
    total = 0.0
    for number in processes:
        # A child may end meanwhile; then its parent's sum includes it.
        with suppress(psutil.NoSuchProcess):
            process = psutil.Process(number)
            for each in (process, *process.children(recursive=True)):
                with suppress(psutil.NoSuchProcess):
                    times = each.cpu_times()
                    total += times.user + times.system + times.children_user + times.children_system
    return total
