"""A fall of rods, step by step or until they rest."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from worker.simulate.rod.arrays import Bodies, flatten
from worker.simulate.rod.bending import Operator, operator_for
from worker.simulate.rod.broad_phase import no_candidates
from worker.simulate.rod.march import Bounds, Outcome, march, prestress
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.tally import COUNT_NAMES, STEPS, new_tally
from worker.simulate.rod.world import world_of

MAX_HALVINGS = 8

MOVE_RADII = 1.0
"""How far nodes may move against each other in a step, in the least radius; faster ones get a finer step."""

WELL_BELOW = 2.2
"""A halved step is doubled again when nodes move so many times less than they may."""

MAX_EXPLICIT_SHARE = 0.25
"""Of the explicit pull towards the natural shape in the implicit rest; from 1 on it would be unstable."""

NEVER_RESTS = (-1.0, -1.0, np.inf)


class DivergedError(Exception):
    """The rods' speeds are no longer numbers."""


@dataclass(frozen=True, slots=True)
class Energy:
    """Energy of all rods together, J. Gravitational energy counts from the origin."""

    kinetic: float
    gravitational: float
    bending: float

    @property
    def total(self) -> float:
        """Their sum."""
        return self.kinetic + self.gravitational + self.bending


class RodSimulation:
    """Rods that fall.

    Attributes:
        step_s: the time step; it is halved while rods move too far against each other in one, or it has no sound end.
    """

    def __init__(self, rods: Sequence[Rod], surroundings: Surroundings, *, steps_per_s: float) -> None:
        """Place the rods at rest where they start."""
        self.step_s = 1.0 / steps_per_s
        self._bodies, self._motion = flatten(rods)
        self._damping = surroundings.damping_s
        self._world = world_of(surroundings)
        self._operators: dict[int, Operator] = {}
        self._least_halvings = self._halvings = _halvings_for_curvature(self._bodies, self.step_s, self._damping)
        self._tally = new_tally()
        prestress(self._bodies, self._operator(), self._motion, self._world)
        self._candidates = no_candidates(len(self._bodies.mass))

    @property
    def time_s(self) -> float:
        """Since the start."""
        return float(self._tally.time[0])

    @property
    def steps(self) -> int:
        """Time steps made."""
        return int(self._tally.counts[STEPS])

    @property
    def counts(self) -> dict[str, int]:
        """What it took, for benchmarks; see `worker.simulate.rod.tally`."""
        return dict(zip(COUNT_NAMES, self._tally.counts.tolist(), strict=True))

    def nodes_m(self, rod: int) -> Array:
        """(N, 3) where a rod's nodes are."""
        return np.ascontiguousarray(self._motion.x[:, self._part(rod)].T)

    def velocities_m_s(self, rod: int) -> Array:
        """(N, 3) how fast they move."""
        return np.ascontiguousarray(self._motion.v[:, self._part(rod)].T)

    def floor_forces_n(self, rod: int) -> Array:
        """(N, 3) of the floor on a rod's nodes, in the last step."""
        force: Array = self._motion.floor_impulse[:, self._part(rod)].T / self._operator().step
        return force

    def contact_force_n(self, one: int, other: int) -> Array:
        """(3,) of the rod `other` on the rod `one`, in the last step."""
        owner = self._bodies.owner
        pairs = self._candidates
        forward = (owner[pairs.one] == one) & (owner[pairs.other] == other)
        backward = (owner[pairs.one] == other) & (owner[pairs.other] == one)
        impulse = pairs.impulse[forward].sum(axis=0) - pairs.impulse[backward].sum(axis=0)
        force: Array = impulse / self._operator().step
        return force

    def set_velocities(self, rod: int, velocities_m_s: Array) -> None:
        """Give a rod's nodes velocities, (N, 3); pinned ones stay."""
        part = self._part(rod)
        self._motion.v[:, part] = np.where(self._bodies.pinned[part], 0.0, velocities_m_s.T)

    def energy(self) -> Energy:
        """As it is now; stretching has none, as lengths are kept."""
        bodies, x, v = self._bodies, self._motion.x, self._motion.v
        bending = 0.0
        for rod, (length, stiffness) in enumerate(zip(bodies.length, bodies.stiffness, strict=True)):
            nodes, curvature = x[:, self._part(rod)], bodies.curvature[self._part(rod)][1:-1]
            edges = np.diff(nodes, axis=1)
            turn = edges[0, :-1] * edges[1, 1:] - edges[1, :-1] * edges[0, 1:]
            bending += stiffness / (2 * length**3) * float(np.sum(np.diff(edges, axis=1) ** 2))
            bending -= stiffness / length**2 * float(np.sum(curvature * turn))
        return Energy(
            kinetic=0.5 * float(np.sum(bodies.mass * v**2)),
            gravitational=-float(np.sum(bodies.mass * (self._world.gravity @ x))),
            bending=bending,
        )

    def advance(self, steps: int) -> None:
        """Make so many steps of `step_s`, or of its halves where it had to be halved.

        Raises:
            DivergedError: if the state is no longer finite.
        """
        self._march(steps, NEVER_RESTS, np.inf)

    def settle(self, *, rms_m_s: float, fastest_m_s: float, quiet_s: float, max_time_s: float) -> bool:
        """Go on until all nodes have been slow for `quiet_s`; returns whether that was reached by `max_time_s`.

        Raises:
            DivergedError: if the state is no longer finite.
        """
        return self._march(1 << 40, (rms_m_s, fastest_m_s, quiet_s), max_time_s) is Outcome.RESTED

    def _march(self, steps: int, rest: tuple[float, float, float], max_time_s: float) -> Outcome:
        end = self.steps + steps
        while self.steps < end and self.time_s < max_time_s:
            bounds = self._bounds(end - self.steps, rest, max_time_s)
            code, self._candidates = march(
                self._bodies, self._operator(), self._motion, self._world, self._candidates, self._tally, bounds
            )
            match Outcome(code):
                case Outcome.TOO_FAST | Outcome.UNSOUND:
                    self._change_step(self._halvings + 1)
                case Outcome.SLOW_ENOUGH:
                    self._change_step(self._halvings - 1)
                case Outcome.DIVERGED:
                    raise DivergedError(f"after {self.time_s:.4g} s")
                case Outcome.RESTED:
                    return Outcome.RESTED
                case Outcome.STEPS_DONE:
                    pass
        return Outcome.STEPS_DONE

    def _bounds(self, steps: int, rest: tuple[float, float, float], max_time_s: float) -> Bounds:
        left = (max_time_s - self.time_s) / self._operator().step
        finest, coarsest = self._halvings >= MAX_HALVINGS, self._halvings <= self._least_halvings
        move = MOVE_RADII * float(self._bodies.radius.min())
        return Bounds(
            steps=min(steps, int(np.ceil(left))) if np.isfinite(left) else steps,
            rest_rms=rest[0],
            rest_fastest=rest[1],
            rest_s=rest[2],
            horizon=2 * self.step_s,
            most_move=np.inf if finest else move,
            few_move=-1.0 if coarsest else move / WELL_BELOW,
            finest=finest,
        )

    def _change_step(self, halvings: int) -> None:
        ratio = 2.0 ** (self._halvings - halvings)
        self._motion.floor_impulse[:] *= ratio
        self._candidates.impulse[:] *= ratio
        self._halvings = halvings

    def _operator(self) -> Operator:
        if self._halvings not in self._operators:
            step = self.step_s / 2**self._halvings
            self._operators[self._halvings] = operator_for(self._bodies, step, self._damping)
        return self._operators[self._halvings]

    def _part(self, rod: int) -> slice:
        return slice(int(self._bodies.first[rod]), int(self._bodies.first[rod + 1]))


def _halvings_for_curvature(bodies: Bodies, step_s: float, damping_s: float) -> int:
    """How often the step must be halved for the explicit pull towards the natural shape to be stable.

    Against rho A + h (h + tau) EI q^4, the implicit part, a wave of number q is pulled by h^2 EI k q^3. The ratio is
    greatest at q = 3^(1/4) / a, where it is 0.57 k a h / (h + tau); a = (h (h + tau) EI / rho A)^(1/4) is the length
    over which the rod responds within a step.
    """
    owner_curvature = np.array(
        [np.abs(bodies.curvature[a:b]).max() for a, b in zip(bodies.first[:-1], bodies.first[1:], strict=True)]
    )
    mass_per_length = bodies.mass[bodies.first[:-1] + 1] / bodies.length
    for halvings in range(MAX_HALVINGS):
        h = step_s / 2**halvings
        response_length = (bodies.stiffness * h * (h + damping_s) / mass_per_length) ** 0.25
        if np.max(0.57 * h / (h + damping_s) * owner_curvature * response_length) <= MAX_EXPLICIT_SHARE:
            return halvings
    return MAX_HALVINGS
