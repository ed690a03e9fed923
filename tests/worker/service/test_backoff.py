"""The backoff of a worker."""

import shutil
import threading
import time
from collections import namedtuple
from collections.abc import Iterator
from pathlib import Path

import pytest

from worker.service import backoff as backoff_module
from worker.service.backoff import Backoff, free_bytes

MIB = 2**20
Usage = namedtuple("Usage", "total used free")


class Clock:
    """A clock that the test moves."""

    now_s = 1000.0

    def __call__(self) -> float:
        """The time, in seconds."""
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    """The worker's clock."""
    return Clock()


@pytest.fixture
def backoff(tmp_path: Path, clock: Clock) -> Backoff:
    """A backoff for a store whose disk has enough room."""
    return Backoff(str(tmp_path), 0, clock)


def pause_after_failure(backoff: Backoff, clock: Clock) -> float:
    """Duration for which a failure holds the worker back, whole seconds."""
    backoff.fail("disk full")
    start_s = clock.now_s
    while backoff.reason():
        assert backoff.reason() == "disk full"
        clock.now_s += 1.0
    return clock.now_s - start_s


def test_nothing_holds_at_first(backoff: Backoff) -> None:
    """A worker whose store hasn't failed takes jobs."""
    assert backoff.reason() == ""


def test_pauses_grow(backoff: Backoff, clock: Clock) -> None:
    """Each failure in a row holds twice as long as the last, up to a minute; a success starts again."""
    assert [pause_after_failure(backoff, clock) for _ in range(7)] == [2, 4, 8, 16, 32, 60, 60]
    backoff.succeed()
    assert pause_after_failure(backoff, clock) == 2


def test_success_does_not_end_a_pause(backoff: Backoff) -> None:
    """A job that succeeds beside a failure doesn't end the pause."""
    backoff.fail("disk full")
    backoff.succeed()
    assert backoff.reason() == "disk full"


def test_low_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With less free space than required the worker is held, and the reason states it; freed space releases it."""
    free = [9 * MIB]
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(100 * MIB, 0, free[0]))
    backoff = Backoff(str(tmp_path), 10 * MIB)
    assert backoff.reason() == f"{tmp_path}: 9 MiB free, kept free are 10; make room"
    free[0] = 10 * MIB
    assert backoff.reason() == ""


@pytest.fixture
def hanging(monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[threading.Event, list[str]]]:
    """An event that ends the hang of a store with much room, and the questions that were asked of it."""
    answers = threading.Event()
    asked: list[str] = []

    def hang(store: str) -> Usage:
        asked.append(store)
        answers.wait()
        return Usage(100 * MIB, 0, 50 * MIB)

    monkeypatch.setattr(shutil, "disk_usage", hang)
    monkeypatch.setattr(backoff_module, "_ANSWER_S", 0.01)
    yield answers, asked
    answers.set()


def answered(backoff: Backoff) -> None:
    """Wait until the store's answer is there."""
    while backoff.reason():
        time.sleep(0.001)


def test_store_that_hangs(clock: Clock, hanging: tuple[threading.Event, list[str]]) -> None:
    """A store that gives no answer holds the worker without hanging it, and is asked only once meanwhile."""
    answers, asked = hanging
    backoff = Backoff("/store", MIB, clock)
    for _ in range(50):
        assert backoff.reason() == "/store: gives no answer; is its file server there? waiting for it"
        clock.now_s += 60.0
    assert asked == ["/store"]
    assert backoff.store_hangs
    answers.set()
    answered(backoff)
    assert not backoff.store_hangs


def test_store_that_is_slow(clock: Clock, hanging: tuple[threading.Event, list[str]]) -> None:
    """An answer that is a few seconds old counts while the next one is awaited; an older one does not."""
    answers, _ = hanging
    answers.set()
    backoff = Backoff("/store", MIB, clock)
    answered(backoff)
    answers.clear()
    clock.now_s += 1.0
    assert backoff.reason() == ""
    clock.now_s += 8.0
    assert backoff.reason() == ""
    clock.now_s += 2.0
    assert "gives no answer" in backoff.reason()


@pytest.mark.parametrize("store", ["s3://bucket/folder", "memory://folder", "/nowhere/at/all"])
def test_room_that_is_not_known(store: str) -> None:
    """The free space of a bucket, or of a folder that doesn't exist yet, is unknown and holds nobody."""
    assert free_bytes(store) is None
    assert Backoff(store, 2**62).reason() == ""


def test_room_by_url(tmp_path: Path) -> None:
    """The free space of a local folder is also known by its URL."""
    assert free_bytes(f"file://{tmp_path}") is not None
    assert "make room" in Backoff(f"file://{tmp_path}", 2**62).reason()
