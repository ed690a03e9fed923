"""A fall that is watched: the worker's own simulation stops every now and then, to look for cables that passed."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from unittest.mock import patch

import numpy as np

from benchmarks.physics.passes import Passage, PassWatch
from farm.scene.physics import GRAVITY_M_S2
from worker.simulate.rod import fall
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation, TooManyStepsError

LOOK_RADII = 0.5
"""Distance, in the least radius, that some node may move between two looks. The axes of two rods that touch are at
least two radii apart, so rods that only move past each other can't seem to pass: together they come a radius nearer."""

MOST_STEPS = 32
"""Most steps made at once; 32 of the default's are about as long as cables must rest."""


class WatchedSimulation(RodSimulation):
    """A fall of rods during which passages of rods through each other and themselves are counted.

    Looking changes no bit of the fall: the same steps are made, in several calls.

    Attributes:
        watch: counts the passages.
        escaped: whether a rod went farther than `reach_m`, which ends the fall.
    """

    def __init__(
        self,
        rods: Sequence[Rod],
        surroundings: Surroundings,
        *,
        steps_per_s: float,
        reach_m: float = np.inf,
        parting_s: float = 0.0,
    ) -> None:
        """Place the rods at rest in their starting places.

        Args:
            rods: rods, at least one.
            surroundings: forces and surfaces that act on them.
            steps_per_s: number of time steps in a second.
            reach_m: distance of a node from the origin, along an axis, beyond which its rod has been flung away.
            parting_s: time until which passages do not count, since no side is the right one.
        """
        super().__init__(rods, surroundings, steps_per_s=steps_per_s)
        self._rods = range(len(rods))
        self._reach_m, self._parting_s = reach_m, parting_s
        self._look_m = LOOK_RADII * float(self._bodies.radius.min())
        self._moved_m = self._speed_m_s = 0.0
        self.escaped = False
        self._seen_s: dict[Passage, float] = {}
        self.watch = PassWatch(tuple(rod.nodes_m for rod in rods), np.array([rod.radius_m for rod in rods]))

    def settle(
        self, *, rms_m_s: float, fastest_m_s: float, quiet_s: float, max_time_s: float, max_steps: int = 1 << 40
    ) -> bool:
        """Make time steps until the rods rest, as `RodSimulation` does, or until one has been flung away."""
        end = self.steps + max_steps
        self._speed_m_s = self._fastest_m_s()
        while not self.escaped:
            stride = min(self._stride(), end - self.steps)
            before_s = self.time_s
            try:
                rested = super().settle(
                    rms_m_s=rms_m_s,
                    fastest_m_s=fastest_m_s,
                    quiet_s=quiet_s,
                    max_time_s=max_time_s,
                    max_steps=stride,
                )
            except TooManyStepsError:
                self._follow(self.time_s - before_s)
                if self.steps >= end:
                    raise
            else:
                self._look()
                return rested
        return False

    def describe_passages(self) -> list[str]:
        """Say of each passage that stands which rods it was of, where, and when; sticks count on after the cables."""
        return [
            f"rods {one} and {other} at {here:.1f} and {there:.1f} radii along, {self._seen_s[passage]:.4f} s"
            + (", near an end" if passage.near_end else "")
            for passage in self.watch.standing
            for (one, other), (here, there) in [(passage.cables, passage.along_radii)]
        ]

    def _stride(self) -> int:
        """Number of steps in which no node is about to move too far; gravity makes it faster on the way."""
        step_s, speed = self._operator().step, self._speed_m_s
        while_s = (np.sqrt(speed**2 + 4 * GRAVITY_M_S2 * self._look_m) - speed) / (2 * GRAVITY_M_S2)
        return int(min(max(while_s / step_s, 1.0), MOST_STEPS))

    def _fastest_m_s(self) -> float:
        """Speed of the fastest node, less what all nodes have in common: rods that move together do not meet.

        The common speed downwards only counts in the air, as a rod that lands is stopped at once.
        """
        v = self._motion.v - self._motion.v.mean(axis=1, keepdims=True)
        down, while_s = self._motion.v[2], MOST_STEPS * self._operator().step
        falling_m = (float(-down.min()) + GRAVITY_M_S2 * while_s) * while_s
        if float(self._motion.x[2].min()) < falling_m + float(self._bodies.radius.max()):
            v[2] = down
        return float(np.sqrt(np.einsum("ij,ij->j", v, v).max()))

    def _follow(self, while_s: float) -> None:
        """Look, if some node may have moved far enough; forget what was seen while sides are not settled."""
        self._speed_m_s = self._fastest_m_s()
        self._moved_m += self._speed_m_s * while_s
        self.escaped = float(np.abs(self._motion.x).max()) > self._reach_m
        if self._moved_m > self._look_m and not self.escaped:
            self._look()
        if self.time_s < self._parting_s:
            self.watch.forget()

    def _look(self) -> None:
        self._moved_m = 0.0
        self.watch.see(tuple(self.nodes_m(rod) for rod in self._rods))
        for passage in self.watch.standing:
            self._seen_s.setdefault(passage, self.time_s)


@contextmanager
def watching(reach_m: float) -> Iterator[list[WatchedSimulation]]:
    """Let the worker's `drop_cables` play its falls with watched simulations, which are listed as they are made.

    Args:
        reach_m: distance from the origin beyond which a rod has been flung away.
    """
    made: list[WatchedSimulation] = []

    def make(rods: Sequence[Rod], surroundings: Surroundings, *, steps_per_s: float) -> WatchedSimulation:
        made.append(WatchedSimulation(rods, surroundings, steps_per_s=steps_per_s, reach_m=reach_m))
        return made[-1]

    with patch.object(fall, "RodSimulation", make):
        yield made
