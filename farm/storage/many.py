"""Asks a store for many things at a time: what counts is how long it takes to answer, not how much it sends."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
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
    function raises comes up in its turn, and ends the rest.

    Args:
        function: the function; it must be safe to call in several threads.
        items: the items; they are taken in the caller's thread.
        at_a_time: maximum number of threads.
    """
    waiting: deque[Future[Result]] = deque()
    with ThreadPoolExecutor(at_a_time) as threads:
        try:
            for item in items:
                waiting.append(threads.submit(function, item))
                if len(waiting) >= _AHEAD * at_a_time:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        finally:
            for future in waiting:
                future.cancel()
