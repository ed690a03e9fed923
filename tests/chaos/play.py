"""Playing one scenario: the farm starts, faults strike as scheduled, and what comes of it is judged."""

import shutil
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import redis

from farm.dataset.completion import Completion
from tests.chaos.farm_under_test import FarmUnderTest, Plan, farm_under_test
from tests.chaos.faults import NotNowError, Undo, strike
from tests.chaos.judge import Claims, Judgement, judge, starts
from tests.chaos.messages import remember
from tests.chaos.schedule import Event

_LOOK_S = 0.02


@dataclass(frozen=True, slots=True)
class Struck:
    """A fault that was injected: when, in seconds from the farm's start, and after how many done jobs."""

    event: Event
    at_s: float
    done: int


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a scenario.

    Attributes:
        findings: what did not hold; none if all did.
        skipped: why it could not be played; None if it was.
        seconds: from the farm's start until its coordinator ended.
        starts: how often a job was begun; None where workers keep no journal.
        written_again: manifests put in place beyond each job's first.
        restarts: how often supervisors had to start something again.
        growth: seconds and done jobs, at each manifest.
        left: where the logs lie, if something did not hold.
    """

    scenario: str
    jobs: int
    findings: tuple[str, ...]
    skipped: str | None = None
    notes: tuple[str, ...] = ()
    scheduled: int = 0
    struck: tuple[Struck, ...] = ()
    seconds: float = 0.0
    starts: int | None = None
    written_again: int = 0
    restarts: int = 0
    quarantined: tuple[str, ...] = ()
    growth: tuple[tuple[float, int], ...] = ()
    left: Path | None = None

    @property
    def held(self) -> bool:
        """Whether all held."""
        return not self.findings


@dataclass(slots=True)
class _Course:
    """How far a scenario is."""

    waiting: list[Event]
    start_s: float = field(default_factory=time.monotonic)
    struck: list[Struck] = field(default_factory=list)
    undo: list[tuple[float, Undo]] = field(default_factory=list)


def play(
    plan: Plan, claims: Claims, events: Sequence[Event], folder: Path, patience_s: float, *, keep: bool = False
) -> Outcome:
    """Play a scenario.

    Args:
        plan: of the farm.
        claims: what must hold at the end.
        events: the faults, by the time at which they strike.
        folder: takes everything in a folder of the dataset's name, which remains if something did not hold.
        patience_s: how long all of it may take.
        keep: leave the folder in any case.
    """
    root = folder / plan.dataset
    with farm_under_test(root, plan) as farm:
        course = _Course(list(events))
        in_time = _run(farm, course, patience_s)
        seconds = time.monotonic() - course.start_s
        findings = [] if in_time else [_unfinished(farm, course, patience_s)]
        if course.waiting and in_time:
            findings.append(f"it was over before these struck: {', '.join(event.fault for event in course.waiting)}")
        verdict = judge(farm, claims)
        findings += verdict.findings
        if findings and farm.disk is not None:
            shutil.copytree(farm.store, root / "store-kept")  # the disk goes with the farm
    outcome = _outcome(farm, course, verdict, tuple(findings), seconds)
    if outcome.held and not keep:
        shutil.rmtree(root)
    return outcome


def _outcome(
    farm: FarmUnderTest, course: _Course, verdict: Judgement, findings: tuple[str, ...], seconds: float
) -> Outcome:
    begun = starts(farm)
    return Outcome(
        scenario=farm.plan.dataset,
        jobs=farm.plan.header.spec.total,
        findings=findings,
        notes=verdict.notes,
        scheduled=len(course.struck) + len(course.waiting),
        struck=tuple(course.struck),
        seconds=seconds,
        starts=sum(begun.values()) or None,
        written_again=farm.manifests.again,
        restarts=sum(service.starts - 1 for service in farm.services),
        quarantined=verdict.quarantined,
        growth=tuple(farm.manifests.growth),
        left=farm.root if findings else None,
    )


def _run(farm: FarmUnderTest, course: _Course, patience_s: float) -> bool:
    """Let the farm work, and the faults strike, until its coordinator says that it is done; whether it does in time."""
    try:
        while time.monotonic() - course.start_s < patience_s:
            farm.supervise()
            _undo_what_is_over(course)
            if farm.coordinator.ended_with is not None and not course.undo:
                return True
            with suppress(redis.RedisError):
                _remember_early(farm)
            if farm.coordinator.ended_with is None:
                _strike_what_is_due(farm, course)
            time.sleep(_LOOK_S)
        return False
    finally:
        for _, undo in course.undo:
            undo()
        course.undo.clear()


def _remember_early(farm: FarmUnderTest) -> None:
    """Take copies of the messages until a few jobs are done; from then on all have been in the queue."""
    if len(farm.manifests.seen()) < 3:
        remember(farm)


def _undo_what_is_over(course: _Course) -> None:
    now = time.monotonic()
    over = [undo for until_s, undo in course.undo if until_s <= now]
    course.undo = [(until_s, undo) for until_s, undo in course.undo if until_s > now]
    for undo in over:
        undo()


def _strike_what_is_due(farm: FarmUnderTest, course: _Course) -> None:
    done = len(farm.manifests.seen())
    for event in list(course.waiting):
        if event.after * farm.plan.header.spec.total > done:
            return
        with suppress(NotNowError):
            undo = strike(event, farm)
            now = time.monotonic()
            course.waiting.remove(event)
            course.struck.append(Struck(event, now - course.start_s, done))
            if undo is not None:
                course.undo.append((now + event.lasts_s, undo))


def _unfinished(farm: FarmUnderTest, course: _Course, patience_s: float) -> str:
    missing = [job.id for job in Completion(farm.dataset).look().others()]
    shown = ", ".join(missing[:5]) + (" and more" if len(missing) > 5 else "")
    words = "; ".join(f"{service.name} said last: {service.last_words()}" for service in farm.services)
    strikes = ", ".join(event.fault for event in course.waiting)
    waits = f"; still to strike: {strikes}" if strikes else ""
    return f"not over after {patience_s:.0f} s: {len(missing)} missing ({shown}){waits}; {words}"
