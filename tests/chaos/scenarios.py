"""The scenarios: each has a dataset of its own, and faults that strike while it is made."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from farm.spec.quotas import split_total
from tests.chaos.expected import drawn_by_stand_in
from tests.chaos.farm_under_test import CLAIM_S, Plan
from tests.chaos.judge import Claims
from tests.chaos.schedule import Fault, Recipe, scenario_generator
from tests.stand_in import stand_in_header

STAND_IN = (sys.executable, "-P", str(Path(__file__).parents[1] / "stand_in.py"))

_SHORT_S = (0.3, 3.0)
_OVER_A_CLAIM_S = (CLAIM_S + 1.0, 2 * CLAIM_S)
_OVER_ITS_MENDING_S = (CLAIM_S + 13.0, CLAIM_S + 15.0)
"""Seconds longer than a claim's term and a coordinator's patience together, so that another worker makes the job."""

_OVER_THE_WATCHDOG_S = (100.0, 105.0)
"""Seconds longer than the 90 s after which the watchdog ends a worker whose event loop is silent."""

_OVER_A_RESTORING_S = (11.0, 13.0)
"""Seconds longer than the 10 s between two of Celery's looks for messages that weren't acknowledged in time."""

_ATTEMPTS = 3
"""Starts of a job that always takes its process with it, before it is given up."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """A dataset to make, and the faults that strike meanwhile.

    Attributes:
        name: name of the scenario and of its dataset.
        jobs: number of images of the dataset, over all categories.
        recipes: the faults.
        workers: number of workers, each with a concurrency of one.
        delay_s: least time that a stand-in takes for an image.
        lethal: number of jobs that take their process with them, by a segmentation fault.
        with_clock: whether the scenario needs a clock that can be set wrong.
        with_disk: whether the scenario needs a small disk.
        with_hang: whether the scenario needs a store that can hang.
        workers_stay: whether no worker may end before it is told to.
        told: words that the coordinator must print meanwhile; empty for none.
        patience_s: longest time that the scenario may take.
    """

    name: str
    jobs: int
    recipes: Sequence[Recipe]
    workers: int = 2
    delay_s: float = 0.12
    lethal: int = 0
    with_clock: bool = False
    with_disk: bool = False
    with_hang: bool = False
    workers_stay: bool = False
    told: str = ""
    patience_s: float = 120.0

    def for_stand_ins(self, seed: int) -> tuple[Plan, Claims]:
        """The plan of the farm with stand-in workers, and the claims on its end."""
        quotas = {str(category): quota for category, quota in split_total(self.jobs).items()}
        header = stand_in_header(seed=seed, **quotas)
        jobs = list(header.spec.jobs())
        # These jobs are among the first, so that others are left to do while they are tried again.
        chosen = scenario_generator(seed, f"lethal {self.name}").choice(len(jobs) // 2, self.lethal, replace=False)
        lethal = frozenset(jobs[place].id for place in chosen)
        fails = " ".join(f"{job_id}=segfault" for job_id in sorted(lethal))
        plan = Plan(
            dataset=self.name,
            header=header,
            worker=STAND_IN,
            workers=self.workers,
            environment={"STAND_IN_DELAY_S": str(self.delay_s), "STAND_IN_FAILS": fails},
            with_clock=self.with_clock,
            with_disk=self.with_disk,
            with_hang=self.with_hang,
        )
        starts = _ATTEMPTS if lethal and not self.recipes else None
        return plan, Claims(drawn_by_stand_in(header), lethal, starts, workers_stay=self.workers_stay, told=self.told)


STORM: Sequence[Recipe] = (
    Recipe(Fault.KILL_CHILD, 4),
    Recipe(Fault.KILL_WORKER, 3),
    Recipe(Fault.KILL_COORDINATOR, 3),
    Recipe(Fault.STOP_CHILD, 2, _OVER_A_CLAIM_S),
    Recipe(Fault.STOP_WORKER, 2, _OVER_A_CLAIM_S),
    Recipe(Fault.EMPTY_REDIS, 2, _SHORT_S),
    Recipe(Fault.RESTART_REDIS, 2, _SHORT_S),
    Recipe(Fault.CUT, 2),
    Recipe(Fault.REFUSE, 2, _SHORT_S),
    Recipe(Fault.BLACKHOLE, 2, _SHORT_S),
    Recipe(Fault.BLOCK_FOLDER, 2, _SHORT_S),
    Recipe(Fault.FILL_DISK, 2, _SHORT_S),
    Recipe(Fault.HANG_STORE, 2, _SHORT_S),
    Recipe(Fault.TRUNCATE_FILE, 2),
    Recipe(Fault.ALTER_FILE, 2),
    Recipe(Fault.REMOVE_MANIFEST, 2),
    Recipe(Fault.DUPLICATE, 1),
    Recipe(Fault.REDELIVER_DONE, 2),
    Recipe(Fault.LOSE_MESSAGES, 2),
    Recipe(Fault.POISON, 2),
    Recipe(Fault.JUMP_CLOCK, 2, _SHORT_S),
)

SCENARIOS: Sequence[Scenario] = (
    Scenario(
        "storm",
        600,
        STORM,
        workers=3,
        delay_s=0.1,
        lethal=1,
        with_clock=True,
        with_disk=True,
        with_hang=True,
        patience_s=300.0,
    ),
    Scenario(
        "store-hung",
        120,
        [Recipe(Fault.HANG_STORE, 1, _OVER_THE_WATCHDOG_S), Recipe(Fault.HANG_STORE, 2, _SHORT_S)],
        with_hang=True,
        workers_stay=True,
        told="gives no answer",
        patience_s=300.0,
    ),
    Scenario("child-killed", 120, [Recipe(Fault.KILL_CHILD, 6)]),
    Scenario("worker-killed", 120, [Recipe(Fault.KILL_WORKER, 4)]),
    Scenario("coordinator-killed", 120, [Recipe(Fault.KILL_COORDINATOR, 4)]),
    Scenario(
        "process-stopped",
        120,
        [
            Recipe(Fault.STOP_CHILD, 2, _OVER_A_CLAIM_S),
            Recipe(Fault.STOP_WORKER, 2, _OVER_A_CLAIM_S),
            Recipe(Fault.STOP_CHILD, 1, _OVER_ITS_MENDING_S),
            Recipe(Fault.STOP_WORKER, 1, _OVER_ITS_MENDING_S),
        ],
    ),
    Scenario("redis-emptied", 120, [Recipe(Fault.EMPTY_REDIS, 3, _SHORT_S)]),
    Scenario("redis-restarted", 120, [Recipe(Fault.RESTART_REDIS, 3, _SHORT_S)]),
    Scenario(
        "connection-cut",
        120,
        [Recipe(Fault.CUT, 3), Recipe(Fault.REFUSE, 2, _SHORT_S), Recipe(Fault.BLACKHOLE, 2, (1.0, 5.0))],
    ),
    Scenario("write-errors", 120, [Recipe(Fault.BLOCK_FOLDER, 3, (1.0, 3.0))]),
    Scenario("disk-full", 120, [Recipe(Fault.FILL_DISK, 3, (1.0, 3.0))], with_disk=True),
    Scenario("file-truncated", 120, [Recipe(Fault.TRUNCATE_FILE, 5)]),
    Scenario("file-altered", 120, [Recipe(Fault.ALTER_FILE, 5)]),
    Scenario("manifest-removed", 120, [Recipe(Fault.REMOVE_MANIFEST, 5)]),
    Scenario("messages-doubled", 120, [Recipe(Fault.DUPLICATE, 2), Recipe(Fault.REDELIVER_DONE, 2)]),
    Scenario("messages-lost", 120, [Recipe(Fault.LOSE_MESSAGES, 3)]),
    Scenario("segfault", 80, [], lethal=2),
    Scenario(
        "clock-jumped",
        120,
        [Recipe(Fault.JUMP_CLOCK, 2, (1.0, 4.0)), Recipe(Fault.JUMP_CLOCK, 1, _OVER_A_RESTORING_S)],
        delay_s=0.25,
        with_clock=True,
    ),
    Scenario("queue-poisoned", 120, [Recipe(Fault.POISON, 6)]),
)
"""Scenarios with stand-in workers; the longest comes first, so that scenarios side by side end together."""

SMALL_STORM = Scenario(
    "small-storm",
    60,
    [
        Recipe(Fault.KILL_CHILD, 2),
        Recipe(Fault.KILL_WORKER, 1),
        Recipe(Fault.KILL_COORDINATOR, 1),
        Recipe(Fault.EMPTY_REDIS, 1, (0.3, 0.6)),
        Recipe(Fault.CUT, 1),
        Recipe(Fault.BLACKHOLE, 1, (0.3, 0.6)),
        Recipe(Fault.REMOVE_MANIFEST, 1),
        Recipe(Fault.DUPLICATE, 1),
        Recipe(Fault.LOSE_MESSAGES, 1),
    ],
    delay_s=0.05,
)
"""Scenario for the ordinary test suite."""

BLENDER_SCENARIOS: Sequence[Scenario] = tuple(
    Scenario(f"blender-{name}", 10, recipes, patience_s=180.0)
    for name, recipes in {
        "calm": [],
        "child-killed": [Recipe(Fault.KILL_CHILD, 2)],
        "worker-killed": [Recipe(Fault.KILL_WORKER, 2)],
        "coordinator-killed": [Recipe(Fault.KILL_COORDINATOR, 2)],
        "process-stopped": [
            Recipe(Fault.STOP_CHILD, 1, _OVER_A_CLAIM_S),
            Recipe(Fault.STOP_WORKER, 1, _OVER_A_CLAIM_S),
        ],
        "redis-emptied": [Recipe(Fault.EMPTY_REDIS, 2, _SHORT_S)],
        "connection-cut": [
            Recipe(Fault.CUT, 1),
            Recipe(Fault.REFUSE, 1, _SHORT_S),
            Recipe(Fault.BLACKHOLE, 1, _SHORT_S),
        ],
        "storm": [
            Recipe(Fault.KILL_CHILD, 1),
            Recipe(Fault.KILL_WORKER, 1),
            Recipe(Fault.STOP_CHILD, 1, _OVER_A_CLAIM_S),
            Recipe(Fault.EMPTY_REDIS, 1, _SHORT_S),
            Recipe(Fault.CUT, 1),
        ],
    }.items()
)
"""Scenarios with real Blender; the first has no faults, and the others must make the same bytes."""
