"""Finding a worker that no longer works, with a clock of the tests' own."""

import subprocess
import sys
from dataclasses import replace

import pytest

from worker.service.watchdog import EXIT_CODE, IDLE_LOOKS, LOOK_S, LOOKS, FaultDetector, Observation

WELL = Observation(ticked_s=0.0, busy=False, stopping=False, jobs_wait=False)


class Scene:
    """A detector that looks now and then, and when the worker last ticked."""

    def __init__(self) -> None:
        self.now_s = 1000.0
        self.detector = FaultDetector(lambda: self.now_s)

    def looks(self, count: int, signs: Observation, *, ticks: bool) -> list[str]:
        """A number of looks at the usual pace."""
        told = []
        last_s = self.now_s
        for _ in range(count):
            self.now_s += LOOK_S
            told.append(self.detector.look(replace(signs, ticked_s=self.now_s - 0.5 if ticks else last_s)))
        return told


@pytest.fixture
def scene() -> Scene:
    """A judge that has seen nothing yet."""
    return Scene()


@pytest.mark.parametrize("signs", [WELL, replace(WELL, busy=True), replace(WELL, busy=True, jobs_wait=True)])
def test_worker_that_works(scene: Scene, signs: Observation) -> None:
    """One whose loop comes by, and that is busy where jobs wait, is left alone for ever."""
    assert set(scene.looks(10 * IDLE_LOOKS, signs, ticks=True)) == {""}


@pytest.mark.parametrize("busy", [False, True])
def test_hanging_loop(scene: Scene, busy: bool) -> None:
    """A loop that hasn't ticked for long is noticed, but not before the number of looks."""
    told = scene.looks(3 * LOOKS, replace(WELL, busy=busy), ticks=False)
    first = next(number for number, word in enumerate(told) if word)
    assert told[first] == "its event loop hangs"
    assert first >= LOOKS


def test_process_that_was_stopped(scene: Scene) -> None:
    """A process that slept for hours isn't judged by its single look on waking."""
    scene.looks(5, WELL, ticks=True)
    scene.now_s += 10_000
    stale = replace(WELL, ticked_s=scene.now_s - 10_000)
    assert scene.detector.look(stale) == ""
    assert set(scene.looks(3 * LOOKS, WELL, ticks=True)) == {""}


def test_worker_that_takes_nothing(scene: Scene) -> None:
    """A worker that idles while jobs wait is noticed after the number of looks in succession."""
    told = scene.looks(IDLE_LOOKS, replace(WELL, jobs_wait=True), ticks=True)
    assert told == [""] * (IDLE_LOOKS - 1) + ["it takes no jobs though some wait"]


def test_one_job_in_between(scene: Scene) -> None:
    """A job in between, or a queue that was empty, starts the count again."""
    waiting = replace(WELL, jobs_wait=True)
    for signs in (replace(waiting, busy=True), WELL):
        scene.looks(IDLE_LOOKS - 1, waiting, ticks=True)
        scene.looks(1, signs, ticks=True)
        assert set(scene.looks(IDLE_LOOKS - 1, waiting, ticks=True)) == {""}
        scene.looks(1, signs, ticks=True)


def test_stopping_worker_may_wait_for_its_job(scene: Scene) -> None:
    """A worker that was told to stop needn't tick while its job runs, nor take others."""
    stopping = replace(WELL, stopping=True, busy=True, jobs_wait=True)
    assert set(scene.looks(10 * IDLE_LOOKS, stopping, ticks=False)) == {""}


def test_shutdown_that_never_ends(scene: Scene) -> None:
    """A worker that was told to stop, has no job and is still there is noticed."""
    told = scene.looks(3 * LOOKS, replace(WELL, stopping=True), ticks=False)
    assert "its event loop hangs" in told


def test_redis_that_is_away(scene: Scene) -> None:
    """While Redis is away, no look counts against a worker."""
    scene.looks(IDLE_LOOKS - 1, replace(WELL, jobs_wait=True), ticks=True)
    scene.detector.forget()
    assert set(scene.looks(IDLE_LOOKS - 1, replace(WELL, jobs_wait=True), ticks=True)) == {""}


def test_watched_process_ends() -> None:
    """A process that hangs is ended by its own watchdog, children first, with the code that restarts it."""
    program = (
        "import time, worker.service.watchdog as w; w.LOOK_S = 0.01; w.LOOKS = 3; "
        "w.watch(lambda: w.Observation(time.monotonic() - 9, False, False, False), "
        "lambda: print('children', flush=True)); "
        "time.sleep(120)"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60)
    assert ended.returncode == EXIT_CODE
    assert ended.stdout == "children\n"
    assert "this worker ends itself: its event loop hangs" in ended.stderr


def test_error_of_redis_does_not_end_the_watch() -> None:
    """A look that finds no Redis is ignored, and the next one counts."""
    program = (
        "import time, worker.service.watchdog as w\n"
        "from farm.errors import BrokerError\n"
        "w.LOOK_S = 0.01; w.LOOKS = 3; looks = []\n"
        "def see():\n"
        "    looks.append(1)\n"
        "    if len(looks) < 5: raise BrokerError('away')\n"
        "    return w.Observation(time.monotonic() - 9, False, False, False)\n"
        "w.watch(see, lambda: print(len(looks), flush=True))\n"
        "time.sleep(120)"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60)
    assert ended.returncode == EXIT_CODE
    assert ended.stdout == "7\n"
