"""Holding a worker back."""

import shutil
from collections import namedtuple
from pathlib import Path

import pytest

from worker.service.backoff import Backoff, free_bytes

MIB = 2**20
Usage = namedtuple("Usage", "total used free")


class Clock:
    """Goes on when told to."""

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
    """Of a store whose disk has room enough."""
    return Backoff(str(tmp_path), 0, clock)


def pause_after_failure(backoff: Backoff, clock: Clock) -> float:
    """How long a failure holds the worker, to the second."""
    backoff.fail("disk full")
    start_s = clock.now_s
    while backoff.reason():
        assert backoff.reason() == "disk full"
        clock.now_s += 1.0
    return clock.now_s - start_s


def test_nothing_holds_at_first(backoff: Backoff) -> None:
    """A worker whose store has not failed takes jobs."""
    assert backoff.reason() == ""


def test_pauses_grow(backoff: Backoff, clock: Clock) -> None:
    """Each failure in a row holds twice as long as the last, up to a minute; a success starts again."""
    assert [pause_after_failure(backoff, clock) for _ in range(7)] == [2, 4, 8, 16, 32, 60, 60]
    backoff.succeed()
    assert pause_after_failure(backoff, clock) == 2


def test_success_does_not_end_a_pause(backoff: Backoff) -> None:
    """A job that ended well beside a failure does not open the store again at once."""
    backoff.fail("disk full")
    backoff.succeed()
    assert backoff.reason() == "disk full"


def test_low_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With less room than asked for the worker is held, and told how much there is; room that was made frees it."""
    free = [9 * MIB]
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(100 * MIB, 0, free[0]))
    backoff = Backoff(str(tmp_path), 10 * MIB)
    assert backoff.reason() == f"{tmp_path}: 9 MiB free, kept free are 10; make room"
    free[0] = 10 * MIB
    assert backoff.reason() == ""


@pytest.mark.parametrize("store", ["s3://bucket/folder", "memory://folder", "/nowhere/at/all"])
def test_room_that_is_not_known(store: str) -> None:
    """Of a bucket, and of a folder that is not there yet, the room is not known, and holds nobody."""
    assert free_bytes(store) is None
    assert Backoff(store, 2**62).reason() == ""


def test_room_by_url(tmp_path: Path) -> None:
    """A local folder's room is known by its URL, too."""
    assert free_bytes(f"file://{tmp_path}") is not None
    assert "make room" in Backoff(f"file://{tmp_path}", 2**62).reason()
