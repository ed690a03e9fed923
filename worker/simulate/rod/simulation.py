"""Simulates the fall of rods, for a number of steps or until they rest."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from worker.simulate.rod.arrays import Bodies, flatten
from worker.simulate.rod.bending import Operator, operator_for
from worker.simulate.rod.broad_phase import no_candidates
from worker.simulate.rod.forces import natural_axis
from worker.simulate.rod.march import Bounds, Outcome, march, prestress
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.tally import COUNT_NAMES, STEPS, new_tally
from worker.simulate.rod.world import world_of

MAX_HALVINGS = 8
"""Largest number of times that the time step is halved."""

MAX_DOUBLINGS = 1
"""Largest number of times that the planned time step is doubled, while rods settle slowly. In longer steps sweeps need
more turns than there are fewer steps."""

JOLT_RADII = 0.01
"""Largest distance, in the smallest radius, by which the change of a node's velocity may bend its way in a step that is
longer than planned. Implicit Euler errs by half of it."""

MOVE_RADII = 1.0
"""Largest relative movement of nodes in a step, in the smallest radius; faster nodes get a smaller time step."""

WELL_BELOW = 2.2
"""Ratio of the largest movement allowed in a step to the actual one, above which a halved step is doubled again. It is
more than 2, so that the doubled step is not halved at once."""

MAX_EXPLICIT_SHARE = 0.25
"""Largest ratio of the explicit pull towards the natural shape to the implicit part; from 1 on it would be unstable."""

NEVER_RESTS = (-1.0, -1.0, np.inf)
"""Distances and time of rest, as `Bounds` has them, that no rods reach."""


class DivergedError(Exception):
    """The speeds of the rods are infinite or NaN."""


class TooManyStepsError(Exception):
    """The rods have not come to rest within the steps that a fall may make."""


@dataclass(frozen=True, slots=True)
class Energy:
    """The energy of all rods together, in joules.

    Attributes:
        kinetic: kinetic energy.
        gravitational: gravitational energy, relative to the origin.
        bending: energy of bending about the natural shape, but for a constant.
        pulls: energy of the constant pulls, relative to the origin: it falls by the work that they do.
    """

    kinetic: float
    gravitational: float
    bending: float
    pulls: float

    @property
    def total(self) -> float:
        """Sum of the energies, in joules."""
        return self.kinetic + self.gravitational + self.bending + self.pulls


class RodSimulation:
    """A fall of rods.

    Attributes:
        step_s: planned time step, in seconds. It is halved while rods move too far in one, or while it has no sound
            end, and doubled while landed rods settle without haste.
    """

    def __init__(self, rods: Sequence[Rod], surroundings: Surroundings, *, steps_per_s: float) -> None:
        """Place the rods at rest in their starting places.

        Args:
            rods: rods, at least one.
            surroundings: forces and surfaces that act on them.
            steps_per_s: number of time steps in a second.
        """
        self.step_s = 1.0 / steps_per_s
        self._bodies, self._motion = flatten(rods)
        self._damping = surroundings.damping_s
        self._world = world_of(surroundings)
        self._operators: dict[int, Operator] = {}
        self._coarsest = _halvings_for_curvature(self._bodies, self.step_s, self._damping)
        self._least_halvings = self._halvings = max(self._coarsest, 0)
        self._tally = new_tally()
        prestress(self._bodies, self._operator(), self._motion, self._world)
        self._candidates = no_candidates(len(self._bodies.mass))

    @property
    def time_s(self) -> float:
        """Time since the start, in seconds."""
        return float(self._tally.time[0])

    @property
    def steps(self) -> int:
        """Number of time steps made."""
        return int(self._tally.counts[STEPS])

    @property
    def counts(self) -> dict[str, int]:
        """Counts of the solver's work, for benchmarks; see `worker.simulate.rod.tally`."""
        return dict(zip(COUNT_NAMES, self._tally.counts.tolist(), strict=True))

    def nodes_m(self, rod: int) -> Array:
        """Return the places of a rod's nodes, (N, 3) metres."""
        return np.ascontiguousarray(self._motion.x[:, self._part(rod)].T)

    def velocities_m_s(self, rod: int) -> Array:
        """Return the velocities of a rod's nodes, (N, 3) m/s."""
        return np.ascontiguousarray(self._motion.v[:, self._part(rod)].T)

    def drift_m_s(self, rod: int) -> Array:
        """Return the mean velocities of a rod's nodes, (N, 3) m/s, since they last moved too far to rest.

        They are those of the last step if that has only just happened.
        """
        quiet_s = float(self._tally.quiet[0])
        if quiet_s <= 0.0:
            return self.velocities_m_s(rod)
        part = self._part(rod)
        drift: Array = (self._motion.x[:, part] - self._motion.anchor[:, part]).T / quiet_s
        return np.ascontiguousarray(drift)

    def floor_forces_n(self, rod: int) -> Array:
        """Return the forces of the floor on a rod's nodes in the last step, (N, 3) newtons."""
        force: Array = self._motion.floor_impulse[:, self._part(rod)].T / self._operator().step
        return force

    def contact_force_n(self, one: int, other: int) -> Array:
        """Return the force of the rod `other` on the rod `one` in the last step, (3,) newtons."""
        owner = self._bodies.owner
        pairs = self._candidates
        forward = (owner[pairs.one] == one) & (owner[pairs.other] == other)
        backward = (owner[pairs.one] == other) & (owner[pairs.other] == one)
        impulse = pairs.impulse[forward].sum(axis=0) - pairs.impulse[backward].sum(axis=0)
        force: Array = impulse / self._operator().step
        return force

    def set_velocities(self, rod: int, velocities_m_s: Array) -> None:
        """Set the velocities of a rod's nodes, (N, 3) m/s; pinned nodes stay at rest."""
        part = self._part(rod)
        self._motion.v[:, part] = np.where(self._bodies.pinned[part], 0.0, velocities_m_s.T)
        self._motion.anchor[:] = self._motion.x
        self._tally.quiet[0] = 0.0

    def energy(self) -> Energy:
        """Compute the present energy; rods keep their lengths, so stretching has none."""
        bodies, x, v = self._bodies, self._motion.x, self._motion.v
        bending = 0.0
        for rod, (length, stiffness) in enumerate(zip(bodies.length, bodies.stiffness, strict=True)):
            edges = np.diff(x[:, self._part(rod)], axis=1)
            bending += stiffness / (2 * length**3) * float(np.sum(np.diff(edges, axis=1) ** 2))
            bending -= stiffness / length**2 * natural_axis(bodies, x, rod)[3]
        return Energy(
            kinetic=0.5 * float(np.sum(bodies.mass * v**2)),
            gravitational=-float(np.sum(self._weighing_kg() * (self._world.gravity @ x))),
            bending=bending,
            pulls=-float(np.sum(bodies.pull * x)),
        )

    def _weighing_kg(self) -> Array:
        """The mass of each node, (nodes,), on which gravity acts at present."""
        bodies = self._bodies
        share = np.where(self._motion.landed, 1 / bodies.inertia, 1.0)
        weighing: Array = bodies.mass * share[bodies.owner]
        return weighing

    def advance(self, steps: int) -> None:
        """Make a number of time steps, each of `step_s` or smaller.

        Args:
            steps: number of steps.

        Raises:
            DivergedError: if the state is no longer finite.
        """
        self._march(steps, NEVER_RESTS, np.inf, self._least_halvings)

    @property
    def coarsest_steps_per_s(self) -> float:
        """Number of time steps in a second at the largest time step that keeps the rods' natural curvature stable."""
        return 2.0**self._least_halvings / self.step_s

    def settle(
        self, *, rms_m_s: float, fastest_m_s: float, quiet_s: float, max_time_s: float, max_steps: int = 1 << 40
    ) -> bool:
        """Make time steps until the rods rest.

        Args:
            rms_m_s: root mean square speed of the nodes up to which the rods rest, in m/s.
            fastest_m_s: speed of the fastest node up to which the rods rest, in m/s.
            quiet_s: time over which the speeds are means, in seconds: until its end no node is ever farther from its
                place than these speeds would take it. Within single steps, contacts chatter.
            max_time_s: time since the start at which to stop in any case, in seconds.
            max_steps: number of steps that may be made, halved ones included.

        Returns:
            Whether the rods rest.

        Raises:
            DivergedError: if the state is no longer finite.
            TooManyStepsError: if the steps are made before the rods rest and before the time is over.
        """
        rest = (rms_m_s * quiet_s, fastest_m_s * quiet_s, quiet_s)
        outcome = self._march(max_steps, rest, max_time_s, self._coarsest)
        if outcome is not Outcome.RESTED and self.time_s < max_time_s:
            raise TooManyStepsError(f"after {max_steps} time steps, at {self.time_s:.4g} s")
        return outcome is Outcome.RESTED

    def _march(self, steps: int, rest: tuple[float, float, float], max_time_s: float, coarsest: int) -> Outcome:
        end = self.steps + steps
        self._change_step(max(self._halvings, coarsest))
        while self.steps < end and self.time_s < max_time_s:
            bounds = self._bounds(end - self.steps, rest, max_time_s, coarsest)
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

    def _bounds(self, steps: int, rest: tuple[float, float, float], max_time_s: float, coarsest: int) -> Bounds:
        left = (max_time_s - self.time_s) / self._operator().step
        finest, planned = self._halvings >= MAX_HALVINGS, self._least_halvings
        smallest = float(self._bodies.radius.min())
        move, jolt = MOVE_RADII * smallest, JOLT_RADII * smallest
        return Bounds(
            steps=min(steps, int(np.ceil(left))) if np.isfinite(left) else steps,
            rest_rms=rest[0],
            rest_farthest=rest[1],
            rest_s=rest[2],
            horizon=2 * self.step_s,
            most_move=np.inf if finest else move,
            few_move=-1.0 if self._halvings <= coarsest else move / WELL_BELOW,
            most_jolt=jolt if self._halvings < planned else np.inf,
            few_jolt=jolt / WELL_BELOW**2 if self._halvings <= planned else np.inf,
            finest=finest,
        )

    def _change_step(self, halvings: int) -> None:
        ratio = 2.0 ** (self._halvings - halvings)
        self._motion.floor_impulse[:] *= ratio
        self._candidates.impulse[:] *= ratio
        self._halvings = halvings

    def _operator(self) -> Operator:
        if self._halvings not in self._operators:
            step = self.step_s * 2.0**-self._halvings
            self._operators[self._halvings] = operator_for(self._bodies, step, self._damping)
        return self._operators[self._halvings]

    def _part(self, rod: int) -> slice:
        return slice(int(self._bodies.first[rod]), int(self._bodies.first[rod + 1]))


def _halvings_for_curvature(bodies: Bodies, step_s: float, damping_s: float) -> int:
    """Count the halvings of the time step, negative for doublings, with which the pull to the natural shape is stable.

    A wave of number q is pulled by h^2 EI k q^3, against the implicit part rho A + h (h + tau) EI q^4. The ratio is
    largest at q = 3^(1/4) / a, where it is 0.57 k a h / (h + tau). Here a = (h (h + tau) EI / rho A)^(1/4) is the
    length over which the rod responds within a step.
    """
    owner_curvature = np.array(
        [np.abs(bodies.curvature[a:b]).max() for a, b in zip(bodies.first[:-1], bodies.first[1:], strict=True)]
    )
    mass_per_length = bodies.mass[bodies.first[:-1] + 1] / bodies.length
    for halvings in range(-MAX_DOUBLINGS, MAX_HALVINGS):
        h = step_s * 2.0**-halvings
        response_length = (bodies.stiffness * h * (h + damping_s) / mass_per_length) ** 0.25
        if np.max(0.57 * h / (h + damping_s) * owner_curvature * response_length) <= MAX_EXPLICIT_SHARE:
            return halvings
    return MAX_HALVINGS
