"""Calls that may hang, such as looks at a file server that is away: made in a thread, so that nobody else hangs."""

import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")


class Aside(Generic[T]):
    """Makes a call again and again in a thread, one at a time: a call that hangs is waited for, not repeated.

    The thread ends with the process, whatever it waits for. Nothing here may be used across a fork.

    Args:
        call: the function to call; it raises nothing.
        clock: clock that counts seconds.

    Attributes:
        answer: result of the last call that has ended; None before.
        answered_s: time at which that call began, by the clock; minus infinity before.
    """

    def __init__(self, call: Callable[[], T], clock: Callable[[], float] = time.monotonic) -> None:
        self._call = call
        self._clock = clock
        self._thread: threading.Thread | None = None
        self._began_s = float("-inf")
        self.answer: T | None = None
        self.answered_s = float("-inf")

    @property
    def runs(self) -> bool:
        """Whether a call is under way."""
        return self._thread is not None and self._thread.is_alive()

    @property
    def runs_since_s(self) -> float:
        """Seconds for which the present call has been under way; 0 if none is."""
        return self._clock() - self._began_s if self.runs else 0.0

    def begin(self) -> None:
        """Begin a call, unless one is under way."""
        if not self.runs:
            self._began_s = self._clock()
            self._thread = threading.Thread(target=self._run, args=(self._began_s,), name="aside", daemon=True)
            self._thread.start()

    def _run(self, began_s: float) -> None:
        self.answer = self._call()
        self.answered_s = began_s

    def wait(self, most_s: float | None) -> bool:
        """Wait for the call that is under way, `most_s` seconds or without end; returns whether it has ended."""
        if self._thread is not None:
            self._thread.join(most_s)
        return not self.runs


def patiently(call: Callable[[], T], meanwhile: Callable[[float], None], *, every_s: float) -> T:
    """Make a call that may hang, and do something else now and then while it does.

    Args:
        call: the function to call, in a thread.
        meanwhile: told, in this thread, for how many seconds the call has been under way; what it raises is raised
            here, and the call is left alone.
        every_s: seconds between two calls of `meanwhile`, the first of which comes after as many.

    Returns:
        The call's result. What it raises is raised here.
    """
    raised: list[BaseException] = []

    def catch() -> T | None:
        try:
            return call()
        except BaseException as error:  # it is raised again, in the thread that asked
            raised.append(error)
            return None

    aside = Aside(catch)
    aside.begin()
    while not aside.wait(every_s):
        meanwhile(aside.runs_since_s)
    if raised:
        raise raised[0]
    return aside.answer  # type: ignore[return-value]  # None only where the call's own result is
