"""Asking the store which runs it holds, from a thread."""

import itertools
import threading
import time
from collections.abc import Callable

import pytest

from farm.errors import DestinationError
from farm.run.registry.port import Refusal, Run
from worker.service.holdings import Holdings

RUN = Run(dataset="cables", spec_sha256="0" * 64)
RUNS = {RUN.key: RUN}


class Store:
    """A store whose answer a test changes."""

    def __init__(self) -> None:
        self.answer: Refusal | Exception | None = None
        self.asked = 0

    def look(self, run: Run) -> Refusal | None:
        """Look for a run."""
        del run
        self.asked += 1
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


class Clock:
    """A clock that the test moves."""

    now_s = 0.0

    def __call__(self) -> float:
        """The time, in seconds."""
        return self.now_s


@pytest.fixture
def store() -> Store:
    """A store that holds every run."""
    return Store()


@pytest.fixture
def clock() -> Clock:
    """The worker's clock."""
    return Clock()


@pytest.fixture
def holdings(store: Store, clock: Clock) -> Holdings:
    """What the store holds, with all the patience that a test needs."""
    return Holdings(store.look, clock, patience_s=30.0)


def wait_until(condition: Callable[[], bool]) -> None:
    """Wait for the thread."""
    give_up_s = time.monotonic() + 30
    while not condition():
        assert time.monotonic() < give_up_s
        time.sleep(0.005)


def test_asks_once_for_a_while(holdings: Holdings, store: Store) -> None:
    """A new run is answered at once, and the answer is remembered; a run that is gone is forgotten."""
    assert holdings.judge(RUNS) == holdings.judge(RUNS) == {RUN.key: None}
    assert store.asked == 1
    assert holdings.judge({}) == {}
    assert holdings.judge(RUNS) == {RUN.key: None}
    assert store.asked == 2


def test_asks_again_now_and_then(holdings: Holdings, store: Store, clock: Clock) -> None:
    """A dataset that appears late is found, and one that was replaced is no longer served."""
    store.answer = Refusal.NOT_HERE
    assert holdings.judge(RUNS) == {RUN.key: Refusal.NOT_HERE}
    store.answer = None
    clock.now_s += 2.0
    wait_until(lambda: holdings.judge(RUNS) == {RUN.key: None})
    store.answer = Refusal.OTHER_DESCRIPTION
    clock.now_s += 29.0
    assert holdings.judge(RUNS) == {RUN.key: None}
    clock.now_s += 1.0
    wait_until(lambda: holdings.judge(RUNS) == {RUN.key: Refusal.OTHER_DESCRIPTION})


def test_asks_ever_less_often(holdings: Holdings, store: Store, clock: Clock) -> None:
    """For runs of other stores, of which a shared Redis may hold many, the pauses double, up to a minute."""
    store.answer = Refusal.NOT_HERE
    holdings.judge(RUNS)
    moments = []
    for second in range(400):
        clock.now_s = float(second)
        before = store.asked
        holdings.judge(RUNS)
        if holdings._answers[RUN.key].again_s <= clock.now_s:
            wait_until(lambda before=before: store.asked > before)  # type: ignore[misc]  # bound at once
            wait_until(lambda: holdings._answers[RUN.key].again_s > clock.now_s)
            moments.append(second)
    pauses = [later - earlier for earlier, later in itertools.pairwise(moments)]
    assert pauses[:4] == [4, 8, 16, 32]
    assert set(pauses[4:]) == {60}


def test_asks_at_once_when_told(holdings: Holdings, store: Store) -> None:
    """After a failure of the store its answers are asked for again; until then the former ones hold."""
    holdings.judge(RUNS)
    store.answer = Refusal.NOT_HERE
    holdings.ask_again()
    wait_until(lambda: holdings.judge(RUNS) == {RUN.key: Refusal.NOT_HERE})


def test_changed_entry_is_a_new_question(holdings: Holdings, store: Store) -> None:
    """A run that another release takes over is asked for again."""
    holdings.judge(RUNS)
    store.answer = Refusal.OTHER_RELEASE
    assert holdings.judge({RUN.key: RUN.model_copy(update={"release": "9"})}) == {RUN.key: Refusal.OTHER_RELEASE}


@pytest.mark.parametrize("fault", [DestinationError("stale file handle"), ValueError("a defect")])
def test_store_that_is_away(holdings: Holdings, store: Store, fault: Exception) -> None:
    """A store that can't be asked changes no answer; a run on which it never answered is not served."""
    other = RUN.model_copy(update={"dataset": "wires"})
    holdings.judge(RUNS)
    store.answer = fault
    holdings.ask_again()
    assert holdings.judge(RUNS | {other.key: other}) == {RUN.key: None, other.key: Refusal.UNREADABLE}


def test_store_that_hangs() -> None:
    """A store that hangs keeps the caller once, for an instant, and then leaves its runs out."""
    hangs = threading.Event()
    holdings = Holdings(lambda _: hangs.wait(30) and None, patience_s=0.01)  # type: ignore[arg-type,return-value]  # waits
    try:
        assert holdings.judge(RUNS) == {}
        assert holdings.judge(RUNS) == {}
        assert holdings._waited_for == {RUN.key}
    finally:
        hangs.set()
    wait_until(lambda: holdings.judge(RUNS) == {RUN.key: None})
