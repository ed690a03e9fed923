"""The schedule of faults, drawn from a seed alone, so that the seed replays a run's faults."""

import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

EARLIEST, LATEST = 0.05, 0.8
"""Fractions of a dataset that are done when the first and the last fault may strike: in the middle of the work."""


class Fault(StrEnum):
    """The kinds of faults."""

    KILL_CHILD = "kill child"
    KILL_WORKER = "kill worker"
    KILL_COORDINATOR = "kill coordinator"
    STOP_CHILD = "stop child"
    STOP_WORKER = "stop worker"
    EMPTY_REDIS = "empty Redis"
    RESTART_REDIS = "restart Redis"
    CUT = "cut connections"
    REFUSE = "refuse connections"
    BLACKHOLE = "swallow packets"
    BLOCK_FOLDER = "block folder"
    FILL_DISK = "fill disk"
    HANG_STORE = "hang store"
    TRUNCATE_FILE = "truncate file"
    ALTER_FILE = "alter file"
    REMOVE_MANIFEST = "remove manifest"
    DUPLICATE = "duplicate queue"
    REDELIVER_DONE = "redeliver done"
    LOSE_MESSAGES = "lose messages"
    POISON = "poison queue"
    JUMP_CLOCK = "jump clock"


@dataclass(frozen=True, slots=True)
class Recipe:
    """The number of times that a fault strikes in a scenario, and how long it lasts.

    Attributes:
        fault: kind of the fault.
        times: number of times that the fault strikes, at least 1.
        lasts_s: least and most seconds until the fault is undone; both 0 for a fault without duration.
    """

    fault: Fault
    times: int
    lasts_s: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Event:
    """One scheduled fault.

    Attributes:
        fault: kind of the fault.
        after: fraction of the dataset's jobs that are done when the fault strikes.
        lasts_s: seconds until the fault is undone; 0 for a fault without duration.
        choice: seed of everything else that is chosen when it strikes, such as the victim.
    """

    after: float
    fault: Fault
    lasts_s: float
    choice: int

    def generator(self) -> np.random.Generator:
        """The generator from which the fault's choices are drawn."""
        return np.random.default_rng(self.choice)


def draw_schedule(seed: int, scenario: str, recipes: Sequence[Recipe], *, latest: float = LATEST) -> tuple[Event, ...]:
    """Draw the moments at which the faults of a scenario strike.

    Args:
        seed: seed of the whole chaos run, at least 0.
        scenario: name of the scenario, which keeps its draws apart from those of the others.
        recipes: the faults and their numbers.
        latest: fraction of done jobs by which all have struck, > `EARLIEST`.

    Returns:
        The events that the recipes ask for, ordered by the time at which they strike.
    """
    rng = scenario_generator(seed, scenario)
    events = [
        Event(
            after=float(rng.uniform(EARLIEST, latest)),
            fault=recipe.fault,
            lasts_s=float(rng.uniform(*recipe.lasts_s)),
            choice=int(rng.integers(2**32)),
        )
        for recipe in recipes
        for _ in range(recipe.times)
    ]
    return tuple(sorted(events, key=lambda event: event.after))


def scenario_generator(seed: int, scenario: str) -> np.random.Generator:
    """The random stream of one scenario."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(zlib.crc32(scenario.encode()),)))
