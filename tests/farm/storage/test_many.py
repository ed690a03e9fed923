"""Many calls at a time."""

import subprocess
import sys
import threading
from collections.abc import Iterator

import pytest

from farm.storage import in_order


def test_order_is_kept() -> None:
    """Results come in the order of the items, though later calls end earlier."""
    first_may_end = threading.Event()

    def call(item: int) -> int:
        if item == 0:
            first_may_end.wait(10)
        if item == 3:
            first_may_end.set()
        return item * 10

    assert list(in_order(call, range(100), at_a_time=4)) == [item * 10 for item in range(100)]


def test_items_are_taken_as_needed() -> None:
    """A long series of items is taken a little ahead of its results, not as a whole."""
    taken: list[int] = []

    def items() -> Iterator[int]:
        for item in range(10_000):
            taken.append(item)
            yield item

    results = in_order(lambda item: item, items(), at_a_time=2)
    assert next(results) == 0
    assert len(taken) < 20


def test_failure_comes_up_in_its_turn() -> None:
    """What a call raises is raised after the results before it, and no further item is taken."""
    taken: list[int] = []

    def call(item: int) -> int:
        taken.append(item)
        if item == 5:
            raise KeyError("five")
        return item

    results = in_order(call, range(1000), at_a_time=2)
    assert [next(results) for _ in range(5)] == [0, 1, 2, 3, 4]
    with pytest.raises(KeyError, match="five"):
        next(results)
    assert len(taken) < 30


def test_calls_that_hang_do_not_hold_the_process() -> None:
    """A command whose store hangs can be stopped: the threads end with it."""
    program = """
import time
from farm.aside import Aside
from farm.storage import in_order
aside = Aside(lambda: list(in_order(time.sleep, [600.0])))
aside.begin()
time.sleep(0.2)
"""
    assert subprocess.run([sys.executable, "-c", program], check=False, timeout=60).returncode == 0
