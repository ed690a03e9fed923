"""The tightening of an overhand knot against theory: `python -m benchmarks.physics.knots` prints the table.

Audoly, Clauvelin and Neukirch (2007, "Elastic knots", PRL 99, 164301) find the pull T of an overhand knot in a rod of
radius h and bending stiffness B, whose loop has the radius R, by matched expansions in e = sqrt(h / R), for e << 1:

    T R^2 / B = 1/2 +- mu sigma / e,    sigma = 0.492,    mu << e;

+ if the knot is about to tighten, - if it is about to open. The two strands of the braid press on each other with
sigma B / (h^(1/2) R^(3/2)) in all, so friction outweighs bending where mu > e.

The loop is a circle for e = 0 alone. Their braid problem also tells how it is not: let d be half the distance of the
strands, in h, along the braid, in sqrt(h R). It minimizes the bending |d''|^2 with |d| >= 1 and one and a half turns,
and runs into d = X^2 / 4 - a X at the loop. Solved numerically, a = 1.48 and sigma = 0.490. So the loop is an elastica
that starts and ends on the chord at an angle of -a e to it. At the bearing p its curvature is

    k R = 1 - (2 a / pi) e cos p + O(e^2),    1 / R = sqrt(2 T / B):

it bends least at the top, p = pi, and most where it leaves the braid, p = 0. The mean of these two curvatures has no
term in e, so it is taken for 1 / R: what is left of the error of T R^2 / B is O(e^2), a multiple of h / R.
"""

import sys
from dataclasses import dataclass

import numpy as np

from farm.scene.knot import KnotKind
from worker.simulate.rod.knot_start import loose_knot
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

SIGMA = 0.492
"""Sum of the forces between the strands of an overhand knot's braid, in B / (h^(1/2) R^(3/2))."""

BRAID_SLOPE = 1.48
"""Slope -a of the braid's strands at its end, in sqrt(h / R), solved numerically for this module."""

LOOP_SPREAD = 2 * BRAID_SLOPE / np.pi
"""Factor of e in half the difference of the loop's largest and least curvature, over their mean."""

RADIUS_M = 1e-3
BENDING_N_M2 = 4e-5
DAMPING_S = 0.01
STEPS_PER_S = 1000.0
RESPONSE_LOOPS = 0.75
"""Length of rod that responds to a push within a step, in loop radii: it sets the mass, which the shape at rest does
not depend on."""

SEGMENT_SHARE = 0.45
"""Length of the segments over sqrt(h R), the length over which the braid bends."""

TIGHTER, LOOSER = 0.4, 1.6
"""Size over the asked one of the knot from which one opens or tightens: friction does not hold it yet."""

CASES = (
    *((asked, 0.0) for asked in (10.0, 20.0, 40.0, 80.0)),
    *((20.0, friction) for friction in (0.02, -0.02, 0.05, -0.05, 0.1, -0.1)),
    *((40.0, friction) for friction in (0.03, -0.03)),
)
"""Loop radii asked for, over the rod's radius, and coefficients of friction of the table."""


@dataclass(frozen=True, slots=True)
class Pulled:
    """An overhand knot that was pulled.

    Attributes:
        asked: sqrt(B / 2 T) over the rod's radius h.
        friction: Coulomb's coefficient, negative for a knot that opened.
        loop: radius R of the loop over h, from the mean of its largest and its least curvature.
        spread: half the difference of these two, over their mean.
    """

    asked: float
    friction: float
    loop: float
    spread: float

    @property
    def e(self) -> float:
        """sqrt(h / R)."""
        return float(self.loop**-0.5)

    @property
    def pull(self) -> float:
        """T R^2 / B."""
        return 0.5 * (self.loop / self.asked) ** 2

    @property
    def pull_in_theory(self) -> float:
        """T R^2 / B by Audoly et al."""
        return 0.5 + self.friction * SIGMA / self.e

    @property
    def spread_in_theory(self) -> float:
        """Spread of the loop's curvature for e << 1."""
        return float(LOOP_SPREAD * self.e)


def pull(asked: float, friction: float = 0.0, steps: int = 2500) -> Pulled:
    """Pull an overhand knot by T = B / 2 (`asked` h)^2.

    Args:
        asked: sqrt(B / 2 T) over the rod's radius h.
        friction: Coulomb's coefficient; the knot tightens, or if it is negative opens, until friction holds it.
        steps: time steps.
    """
    segment = SEGMENT_SHARE * asked**0.5
    start = asked * (1.0 if friction == 0 else LOOSER if friction > 0 else TIGHTER)
    nodes = RADIUS_M * loose_knot(KnotKind.OVERHAND, start, segment, 6 * asked)
    force, pinned = np.zeros_like(nodes), np.zeros(len(nodes), np.bool_)
    force[-1, 0] = BENDING_N_M2 / (2 * (asked * RADIUS_M) ** 2)
    force[0, 0] = -force[-1, 0]
    pinned[len(nodes) // 2] = True
    step = 1 / STEPS_PER_S
    mass_per_length = step * (step + DAMPING_S) * BENDING_N_M2 / (RESPONSE_LOOPS * asked * RADIUS_M) ** 4
    rod = Rod(
        nodes_m=nodes,
        radius_m=RADIUS_M,
        youngs_modulus_pa=4 * BENDING_N_M2 / (np.pi * RADIUS_M**4),
        density_kg_m3=mass_per_length / (np.pi * RADIUS_M**2),
        pinned=pinned,
        pull_n=force,
    )
    weightless = Surroundings(
        gravity_m_s2=(0.0, 0.0, 0.0), floor=False, friction_rods=abs(friction), damping_s=DAMPING_S
    )
    simulation = RodSimulation([rod], weightless, steps_per_s=STEPS_PER_S)
    simulation.advance(steps)
    least, most = _curvatures(simulation.nodes_m(0))
    return Pulled(asked, friction, loop=2 / (most + least), spread=(most - least) / (most + least))


def _curvatures(nodes: Array) -> tuple[float, float]:
    """Compute the curvature of the loop's top and the largest one of either half, times the rod's radius.

    Each is a mean over three nodes.
    """
    edges = np.diff(nodes, axis=0)
    bend = RADIUS_M * np.linalg.norm(np.diff(edges, axis=0), axis=1) / float(edges[0] @ edges[0])
    smooth = np.convolve(bend, np.full(3, 1 / 3), "same")
    top = len(smooth) // 2
    return float(smooth[top]), float(smooth[:top].max() + smooth[top:].max()) / 2


def main() -> int:
    """Print the table."""
    sys.stdout.write("asked/h     mu      e    R/h  T R^2/B  theory   error  spread  theory   error\n")
    for asked, friction in CASES:
        knot = pull(asked, friction)
        sys.stdout.write(
            f"{asked:7.0f}  {friction:5.2f}  {knot.e:.3f}  {knot.loop:5.1f}    {knot.pull:.3f}   "
            f"{knot.pull_in_theory:.3f}  {knot.pull / knot.pull_in_theory - 1:+6.1%}   {knot.spread:.3f}   "
            f"{knot.spread_in_theory:.3f}  {knot.spread / knot.spread_in_theory - 1:+6.1%}\n"
        )
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
