"""The number of the machine's cores that the libraries of this process see."""

import os
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def limit_visible_cores(threads: int) -> Iterator[None]:
    """Show a library that is loaded inside `with` only some cores; afterwards this process may run on all of its own.

    Blender's task scheduler (oneTBB) counts cores once, as Blender is loaded, and starts a thread for each. Threads
    beyond those that a render is told to take do not sleep: each keeps a core busy while it waits for work, and the
    worker beside this one then lacks that core.

    Args:
        threads: number of cores to show; 0 shows all.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    seen = set(sorted(allowed)[:threads]) if threads else allowed
    os.sched_setaffinity(0, seen)
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)
