"""Seconds by stage."""

import time

import pytest

from worker.stopwatch import Stopwatch


def test_a_stage_that_comes_twice_adds_up() -> None:
    """Its place is that of its first time."""
    watch = Stopwatch()
    for name in ("fall", "check", "fall"):
        with watch.stage(name):
            time.sleep(0.01)
    assert list(watch.stages_s) == ["fall", "check"]
    assert watch.stages_s["fall"] >= 0.02


def test_a_stage_that_fails_counts() -> None:
    """Its seconds are spent all the same."""
    watch = Stopwatch()
    with pytest.raises(ValueError, match="no"), watch.stage("fall"):
        raise ValueError("no")
    assert watch.stages_s["fall"] >= 0
