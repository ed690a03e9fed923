"""The pauses of a worker whose store is full, can't be written or hangs: each longer than the one before."""

import shutil
import time
from collections.abc import Callable

from farm.aside import Aside

_FIRST_S = 2.0
"""Seconds of the pause after a first failure."""

_LONGEST_S = 60.0
"""Seconds of the longest pause."""

_ANSWER_S = 0.2
"""Seconds that the caller waits for a store's answer; a store that is well gives it within a few milliseconds."""

_OLD_S = 10.0
"""Age of an answer, in seconds, above which it counts for nothing: the store hangs."""


class Backoff:
    """Tells whether a worker may take jobs: not for a while after a failure of its store, nor while its disk is low.

    A store that hangs, as one on a file server that is away, hangs a thread alone. No job is taken until it answers.

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
        self._free = Aside(lambda: free_bytes(store), clock)

    def fail(self, reason: str) -> None:
        """Note a failure: the worker is held back for twice as long as after the one before, up to a minute."""
        self._pause_s = min(_LONGEST_S, max(_FIRST_S, 2.0 * self._pause_s))
        self._until_s = self._clock() + self._pause_s
        self._reason = reason

    def succeed(self) -> None:
        """Note that a picture was written: the next failure is a first one again."""
        self._pause_s = 0.0

    @property
    def store_hangs(self) -> bool:
        """Whether the store has given no answer for a while."""
        return self._free.runs and self._clock() - self._free.answered_s > _OLD_S

    def reason(self) -> str:
        """Return the reason why no job may be taken now; empty if one may be taken."""
        if not self._free.runs:
            self._free.begin()
            self._free.wait(_ANSWER_S)
        if self._clock() < self._until_s:
            return self._reason
        if self.store_hangs:
            return f"{self._store}: gives no answer; is its file server there? waiting for it"
        free = self._free.answer
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
