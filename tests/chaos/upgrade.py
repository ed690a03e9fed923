"""A rolling upgrade: coordinator and workers of two releases on one Redis, in both orders, and with a paused run."""

import shutil
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from farm import __version__
from farm.dataset.quarantine import Quarantine
from farm.run.coordinator import Coordinator
from farm.run.handle import open_new_run
from farm.run.registry.port import Priority, RunState
from farm.run.registry.redis import RedisRegistry
from farm.spec.quotas import split_total
from tests.chaos.expected import drawn_by_stand_in
from tests.chaos.farm_under_test import FarmUnderTest, Plan, farm_under_test
from tests.chaos.judge import Claims, judge, starts, status_of
from tests.chaos.other_release import VERSION, make_other_release
from tests.chaos.play import Course, Outcome, outcome_of
from tests.chaos.scenarios import STAND_IN
from tests.stand_in import stand_in_header

_COORDINATOR = "coordinator"
_PATIENCE_S = 90.0
_STILL_S = 4.0
"""Seconds for which nothing may happen; a worker looks for runs every second."""


@dataclass(frozen=True, slots=True)
class Upgrade:
    """A farm in the middle of an upgrade.

    Attributes:
        name: name of the scenario and of its dataset.
        theirs: services of the other release: the number of a worker, 1 or 2, or `coordinator`.
        late: services that are started when the others have stood still for a while.
        paused: whether the run was submitted and paused by this release before all of them.
        jobs: number of images of the dataset.
    """

    name: str
    theirs: frozenset[str]
    late: frozenset[str]
    paused: bool = False
    jobs: int = 40


UPGRADES: Sequence[Upgrade] = (
    Upgrade("upgrade-workers-first", frozenset({"1"}), frozenset({"2"})),
    Upgrade("upgrade-coordinator-first", frozenset({_COORDINATOR, "2"}), frozenset({"2"})),
    Upgrade("upgrade-paused", frozenset({_COORDINATOR, "1"}), frozenset({_COORDINATOR}), paused=True),
)


def play_upgrade(upgrade: Upgrade, seed: int, folder: Path) -> Outcome:
    """Play a scenario.

    Args:
        upgrade: the scenario.
        seed: seed of the dataset.
        folder: folder that receives a folder named after the dataset, which stays if something didn't hold.
    """
    root = folder / upgrade.name
    quotas = {str(category): quota for category, quota in split_total(upgrade.jobs).items()}
    # The coordinator's release has begun the dataset, but for the one that is paused.
    begun_by = VERSION if _COORDINATOR in upgrade.theirs and not upgrade.paused else __version__
    header = stand_in_header(seed=seed, **quotas).model_copy(update={"farm_version": begun_by})
    plan = Plan(
        dataset=upgrade.name,
        header=header,
        worker=STAND_IN,
        workers=2,
        other=make_other_release(root / "other"),
        theirs=upgrade.theirs,
        late=upgrade.late,
    )
    with farm_under_test(root, plan) as farm:
        course = Course([])
        findings = list(_paused(farm) if upgrade.paused else _unserved(farm))
        for service in farm.late:
            if service.pid is None:
                service.start()
        if not _within(lambda: farm.coordinator.ended_with is not None, farm):
            findings.append(f"not over after {_PATIENCE_S:.0f} s: {farm.coordinator.last_words()}")
        seconds = time.monotonic() - course.start_s
        findings += _starts(farm)
        verdict = judge(farm, Claims(drawn_by_stand_in(header)))
        findings += verdict.findings
    outcome = outcome_of(farm, course, verdict, tuple(findings), seconds)
    if outcome.held:
        shutil.rmtree(root)
    return outcome


def _unserved(farm: FarmUnderTest) -> Iterator[str]:
    """Let the farm stand still without the right worker; nothing may be lost by that, and status must say why."""
    needed = VERSION if _COORDINATOR in farm.plan.theirs else __version__
    told = f"it needs {needed}"
    if not _within(lambda: told in str(status_of(farm).get("unserved")), farm):
        yield f"farm status never says that {told}: {status_of(farm)}"
    yield from _still(farm)


def _paused(farm: FarmUnderTest) -> Iterator[str]:
    """Pause a run before a coordinator of the other release comes; it must stay paused, and then go on."""
    handle, _ = open_new_run(farm.dataset, farm.proxy.url, farm.redis.client, Priority.HIGH)
    registry = RedisRegistry(farm.redis.client)
    registry.change(handle.run.key, RunState.PAUSED)
    Coordinator(farm.dataset, handle).submit_missing()
    before = registry.runs()
    farm.coordinator.start()
    yield from _still(farm)
    if registry.runs() != before:
        yield f"the paused run is now {registry.runs()}"
    registry.change(handle.run.key, RunState.ACTIVE)


def _still(farm: FarmUnderTest) -> Iterator[str]:
    end_s = time.monotonic() + _STILL_S
    while time.monotonic() < end_s:
        farm.supervise()
        time.sleep(0.1)
    if begun := starts(farm):
        yield f"{len(begun)} jobs were begun by workers of the wrong release, or while the run was paused"
    if given_up := Quarantine(farm.dataset).look():
        yield f"{len(given_up)} jobs were given up while the run stood still"
    for key in farm.redis.client.scan_iter("farm:*:starts"):
        yield f"starts were counted in {key}"
    if any(service.starts > 1 for service in farm.services):
        yield "a service ended while the run stood still"


def _starts(farm: FarmUnderTest) -> Iterator[str]:
    wanted = Counter(job.id for job in farm.plan.header.spec.jobs())
    if (begun := starts(farm)) != wanted:
        yield f"jobs were begun more than once, or never: {begun - wanted or wanted - begun}"


def _within(condition: Callable[[], bool], farm: FarmUnderTest) -> bool:
    end_s = time.monotonic() + _PATIENCE_S
    while not condition():
        if time.monotonic() > end_s:
            return False
        farm.supervise()
        time.sleep(0.2)
    return True
