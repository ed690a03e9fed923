"""Asks a store for many things at a time: what counts is how long it takes to answer, not how much it sends."""

import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future
from queue import SimpleQueue
from typing import TypeVar

AT_A_TIME = 32
"""Requests under way at a time: at 20 ms for each, 25,000 take 16 s. Most object stores take thousands a second."""

_AHEAD = 4
"""Results that are made before the first of them is taken, as a multiple of the requests at a time."""

Item = TypeVar("Item")
Result = TypeVar("Result")


def in_order(
    function: Callable[[Item], Result], items: Iterable[Item], *, at_a_time: int = AT_A_TIME
) -> Iterator[Result]:
    """Call a function for many items at a time, in threads, and yield its results in the items' order.

    Items are taken, and results kept, only a few rounds ahead, so that millions of them don't fill the memory. What the
    function raises comes up in its turn, and ends the rest. The threads end with the process: an executor's would be
    waited for, so that a command whose store hangs could not be stopped.

    Args:
        function: the function; it must be safe to call in several threads.
        items: the items; they are taken in the caller's thread.
        at_a_time: maximum number of threads.
    """
    calls: SimpleQueue[tuple[Future[Result], Item] | None] = SimpleQueue()

    def work() -> None:
        while (call := calls.get()) is not None:
            _make(function, *call)

    waiting: deque[Future[Result]] = deque()
    started = 0
    try:
        for item in items:
            if started < at_a_time:
                threading.Thread(target=work, name=f"one of many {started}", daemon=True).start()
                started += 1
            waiting.append(Future())
            calls.put((waiting[-1], item))
            if len(waiting) >= _AHEAD * at_a_time:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()
        for _ in range(started):
            calls.put(None)


def _make(function: Callable[[Item], Result], future: "Future[Result]", item: Item) -> None:
    """Make one call, unless it was cancelled, and hand its result or what it raises to its future."""
    if not future.set_running_or_notify_cancel():
        return
    try:
        future.set_result(function(item))
    except BaseException as error:  # it is raised again, in the thread that asked
        future.set_exception(error)
