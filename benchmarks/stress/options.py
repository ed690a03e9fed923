"""The options of `python -m benchmarks stress`, and what they ask for."""

import argparse
from dataclasses import dataclass
from typing import Any

from benchmarks.stress.kinds import KINDS, Draw, draws_of
from benchmarks.stress.scenes import MOST_STEPS

DEFAULT_RUNS = 2000
"""Extremes unless the command line says otherwise: four times gate 10's 500."""

DEFAULT_PROCESSES = 2
"""Processes at the same time unless the command line says otherwise."""


@dataclass(frozen=True, slots=True)
class StressPlan:
    """What a stress test plays.

    Attributes:
        seed: seed of all scenes.
        runs: number of extremes.
        drawn: number of drawn scenes of each kind; None for each kind's own.
        kinds: names of the kinds to draw; none for all that have a number of their own.
        only: the one scene to play: the number of an extreme, or KIND:JOB; None for all.
        most_steps: time steps of an extreme, after which it is cut off.
        processes: number of processes at the same time.
    """

    seed: int = 0
    runs: int = DEFAULT_RUNS
    drawn: int | None = None
    kinds: tuple[str, ...] = ()
    only: str | None = None
    most_steps: int = MOST_STEPS
    processes: int = DEFAULT_PROCESSES

    def draws(self) -> list[Draw]:
        """List all drawn scenes."""
        chosen = [each for each in KINDS if (each.name in self.kinds if self.kinds else each.falls > 0)]
        return [
            draw
            for kind in chosen
            for draw in draws_of(kind, kind.falls if self.drawn is None else self.drawn, self.seed)
        ]


def add_stress(commands: Any, shared: argparse.ArgumentParser) -> None:
    """Add the command's parser."""
    parser = commands.add_parser("stress", parents=[shared], help="the rod solver at extremes, and on drawn scenes")
    names = [kind.name for kind in KINDS]
    parser.add_argument("--runs", type=int, default=DEFAULT_RUNS, help="number of extremes")
    parser.add_argument("--drawn", type=int, help="number of drawn scenes of each kind")
    parser.add_argument("--kind", action="append", default=[], choices=names, help="kind to draw; repeat for several")
    parser.add_argument("--only", metavar="SCENE", help="the one scene to play: a number, or KIND:JOB")
    parser.add_argument("--most-steps", type=int, default=MOST_STEPS, help="time steps of an extreme")
    parser.add_argument("--processes", type=int, default=DEFAULT_PROCESSES, help="number of processes at once")


def stress_plan_of(options: argparse.Namespace) -> StressPlan:
    """Make the plan that the options ask for."""
    return StressPlan(
        seed=options.seed,
        runs=options.runs,
        drawn=options.drawn,
        kinds=tuple(options.kind),
        only=options.only,
        most_steps=options.most_steps,
        processes=options.processes,
    )
