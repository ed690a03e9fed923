"""Which faults strike when: drawn from a seed alone, so that a seed replays a run's faults."""

import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

EARLIEST, LATEST = 0.05, 0.8
"""Faults strike while this fraction of a dataset is done: in the middle of the work, and early enough to matter."""


class Fault(StrEnum):
    """What can be done to a farm."""

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
    """How often a fault strikes in a scenario, and for how long each time.

    Attributes:
        times: >= 1.
        lasts_s: least and most seconds until it is undone; both 0 for what is done in an instant.
    """

    fault: Fault
    times: int
    lasts_s: tuple[float, float] = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Event:
    """One fault.

    Attributes:
        after: it strikes once this fraction of the dataset's jobs is done.
        lasts_s: seconds until it is undone; 0 for what is done in an instant.
        choice: seed of whatever else is chosen when it strikes, such as the victim among those there are.
    """

    after: float
    fault: Fault
    lasts_s: float
    choice: int

    def generator(self) -> np.random.Generator:
        """Draws the choices."""
        return np.random.default_rng(self.choice)


def draw_schedule(seed: int, scenario: str, recipes: Sequence[Recipe], *, latest: float = LATEST) -> tuple[Event, ...]:
    """Draw when the faults of a scenario strike.

    Args:
        seed: of the whole chaos run, >= 0.
        scenario: its name, which keeps its draws apart from those of the others.
        recipes: what is to strike.
        latest: fraction of done jobs by which all have struck, > `EARLIEST`.

    Returns:
        As many events of each fault as its recipes ask for, by the time at which they strike.
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
