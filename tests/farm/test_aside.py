"""Calls that may hang."""

import threading
from collections.abc import Iterator

import pytest

from farm.aside import Aside, patiently
from farm.errors import DestinationError


@pytest.fixture
def ends() -> Iterator[threading.Event]:
    """An event for which a call waits."""
    event = threading.Event()
    yield event
    event.set()


def test_a_hanging_call_is_not_repeated(ends: threading.Event) -> None:
    """While a call hangs no second one begins; afterwards the answer is there with the time of its question."""
    now_s = [5.0]
    calls = []

    def hang() -> int:
        calls.append(1)
        ends.wait()
        return len(calls)

    aside = Aside(hang, lambda: now_s[0])
    for _ in range(3):
        aside.begin()
        assert not aside.wait(0.0)
        now_s[0] += 10.0
    assert (aside.answer, aside.answered_s, aside.runs_since_s) == (None, float("-inf"), 30.0)
    ends.set()
    assert aside.wait(60.0)
    assert (aside.answer, aside.answered_s, aside.runs_since_s) == (1, 5.0, 0.0)
    aside.begin()
    assert aside.wait(60.0)
    assert (aside.answer, aside.answered_s) == (2, 35.0)


def test_something_else_is_done_meanwhile(ends: threading.Event) -> None:
    """Whoever waits is told now and then for how long, and gets the result in the end."""
    told = []

    def count(seconds: float) -> None:
        told.append(seconds)
        if len(told) == 3:
            ends.set()

    assert patiently(lambda: ends.wait() and "done", count, every_s=0.01) == "done"
    assert len(told) >= 3
    assert told == sorted(told)


def test_a_quick_call_tells_nothing() -> None:
    """A call that ends in time is an ordinary call, and so is its error."""

    def fail() -> None:
        raise DestinationError("no disk")

    def tell(_: float) -> None:
        raise AssertionError("told too early")

    assert patiently(lambda: 7, tell, every_s=60.0) == 7
    with pytest.raises(DestinationError, match="no disk"):
        patiently(fail, tell, every_s=60.0)


def test_the_wait_can_be_broken_off(ends: threading.Event) -> None:
    """An error of the one that waits ends the wait at once."""

    def stop(_: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        patiently(ends.wait, stop, every_s=0.01)
