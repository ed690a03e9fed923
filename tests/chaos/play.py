"""Play one scenario: start the farm, let faults strike as scheduled, and judge the result."""

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
    """A fault that was injected: its time, in seconds from the farm's start, and the number of jobs done by then."""

    event: Event
    at_s: float
    done: int


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result of a scenario.

    Attributes:
        findings: sentences on what didn't hold; empty if everything did.
        skipped: reason why the scenario wasn't played; None if it was.
        seconds: duration from the farm's start to its coordinator's end.
        starts: number of starts of all jobs; None if workers keep no journal.
        written_again: number of manifests put in place beyond each job's first.
        restarts: number of times that supervisors restarted a process.
        growth: seconds, and number of done jobs, at each manifest.
        left: folder of the logs; None if everything held.
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
        """Whether everything held."""
        return not self.findings


@dataclass(slots=True)
class Course:
    """The progress of a scenario."""

    waiting: list[Event]
    start_s: float = field(default_factory=time.monotonic)
    struck: list[Struck] = field(default_factory=list)
    undo: list[tuple[float, Undo]] = field(default_factory=list)


def play(
    plan: Plan, claims: Claims, events: Sequence[Event], folder: Path, patience_s: float, *, keep: bool = False
) -> Outcome:
    """Play a scenario.

    Args:
        plan: plan of the farm.
        claims: demands on the farm's end.
        events: the faults, ordered by the time at which they strike.
        folder: folder that receives a folder named after the dataset, which stays if something didn't hold.
        patience_s: longest time that the scenario may take.
        keep: whether that folder stays in any case.
    """
    root = folder / plan.dataset
    with farm_under_test(root, plan) as farm:
        course = Course(list(events))
        in_time = _run(farm, course, patience_s)
        seconds = time.monotonic() - course.start_s
        findings = [] if in_time else [_unfinished(farm, course, patience_s)]
        if course.waiting and in_time:
            findings.append(f"it was over before these struck: {', '.join(event.fault for event in course.waiting)}")
        verdict = judge(farm, claims)
        findings += verdict.findings
        if findings and farm.disk is not None:
            shutil.copytree(farm.store, root / "store-kept")  # The disk is removed with the farm.
    outcome = outcome_of(farm, course, verdict, tuple(findings), seconds)
    if outcome.held and not keep:
        shutil.rmtree(root)
    return outcome


def outcome_of(
    farm: FarmUnderTest, course: Course, verdict: Judgement, findings: tuple[str, ...], seconds: float
) -> Outcome:
    """The outcome of a scenario whose farm was judged."""
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


def _run(farm: FarmUnderTest, course: Course, patience_s: float) -> bool:
    """Run the farm and its faults until the coordinator ends; returns whether it ended in time."""
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
    """Copy messages until a few jobs are done; by then all messages have been in the queue."""
    if len(farm.manifests.seen()) < 3:
        remember(farm)


def _undo_what_is_over(course: Course) -> None:
    now = time.monotonic()
    over = [undo for until_s, undo in course.undo if until_s <= now]
    course.undo = [(until_s, undo) for until_s, undo in course.undo if until_s > now]
    for undo in over:
        undo()


def _strike_what_is_due(farm: FarmUnderTest, course: Course) -> None:
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


def _unfinished(farm: FarmUnderTest, course: Course, patience_s: float) -> str:
    missing = [job.id for job in Completion(farm.dataset).look().others()]
    shown = ", ".join(missing[:5]) + (" and more" if len(missing) > 5 else "")
    words = "; ".join(f"{service.name} said last: {service.last_words()}" for service in farm.services)
    strikes = ", ".join(event.fault for event in course.waiting)
    waits = f"; still to strike: {strikes}" if strikes else ""
    return f"not over after {patience_s:.0f} s: {len(missing)} missing ({shown}){waits}; {words}"
