"""The backoff of a worker."""

import shutil
from collections import namedtuple
from pathlib import Path

import pytest

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


@pytest.mark.parametrize("store", ["s3://bucket/folder", "memory://folder", "/nowhere/at/all"])
def test_room_that_is_not_known(store: str) -> None:
    """The free space of a bucket, or of a folder that doesn't exist yet, is unknown and holds nobody."""
    assert free_bytes(store) is None
    assert Backoff(store, 2**62).reason() == ""


def test_room_by_url(tmp_path: Path) -> None:
    """The free space of a local folder is also known by its URL."""
    assert free_bytes(f"file://{tmp_path}") is not None
    assert "make room" in Backoff(f"file://{tmp_path}", 2**62).reason()
