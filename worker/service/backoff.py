"""The pauses of a worker whose store is full or can't be written: each longer than the one before."""

import shutil
import time
from collections.abc import Callable

_FIRST_S = 2.0
"""Seconds of the pause after a first failure."""

_LONGEST_S = 60.0
"""Seconds of the longest pause."""


class Backoff:
    """Tells whether a worker may take jobs: not for a while after a failure of its store, nor while its disk is low.

    Args:
        store: folder or URL below which the datasets lie.
        min_free_bytes: free space of the store's disk below which no job is taken; the free space of a URL isn't known.
        clock: clock that counts seconds.
    """

    def __init__(self, store: str, min_free_bytes: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._store = store
        self._min_free_bytes = min_free_bytes
        self._clock = clock
        self._pause_s = 0.0
        self._until_s = float("-inf")
        self._reason = ""

    def fail(self, reason: str) -> None:
        """Note a failure: the worker is held back for twice as long as after the one before, up to a minute."""
        self._pause_s = min(_LONGEST_S, max(_FIRST_S, 2.0 * self._pause_s))
        self._until_s = self._clock() + self._pause_s
        self._reason = reason

    def succeed(self) -> None:
        """Note that a picture was written: the next failure is a first one again."""
        self._pause_s = 0.0

    def reason(self) -> str:
        """Return the reason why no job may be taken now; empty if one may be taken."""
        if self._clock() < self._until_s:
            return self._reason
        free = free_bytes(self._store)
        if free is not None and free < self._min_free_bytes:
            mib = 2**20
            return f"{self._store}: {free // mib} MiB free, kept free are {self._min_free_bytes // mib}; make room"
        return ""


def free_bytes(store: str) -> int | None:
    """Free space of a store; None where it isn't known."""
    if "://" in store and not store.startswith("file://"):
        return None
    try:
        return shutil.disk_usage(store.removeprefix("file://")).free
    except OSError:
        return None  # not there yet: the first write to it will say more
