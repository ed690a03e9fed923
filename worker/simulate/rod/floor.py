"""The floor: the nodes that it may touch, its impulses on them, and the heights at which it carries them."""

from worker.simulate.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import allowed_approach, on_cone
from worker.simulate.rod.curves import point
from worker.simulate.rod.lengths import AT_REST, FREE, IN_HEIGHT
from worker.simulate.rod.model import Array
from worker.simulate.rod.response import push
from worker.simulate.rod.stirring import is_calm, stir

NEAR_FLOOR_RADII = 0.25
"""Gap to the floor, in radii, beyond twice a node's vertical path in a step, above which the floor does not act on the
node: other rods hardly push it that far down."""

SUNK_RADII = 0.004
"""Depth, in radii, to which keeping the lengths may press a node into the floor before the floor holds it."""


@compiled
def find_near_floor(
    bodies: Bodies, motion: Motion, bends: Array, step: float, friction: float, touching: Integers, rise: Array
) -> int:
    """Find the nodes that could reach the floor in this step, and set the floor's impulses on the others to 0.

    Args:
        bodies: the rods.
        motion: state of the rods, whose `floor_impulse` is changed.
        bends: (3, nodes) second derivatives of the curves at the nodes, m.
        step: time step, s.
        friction: Coulomb's coefficient.
        touching: (nodes,) array that gets the numbers of these nodes, ascending, from its beginning.
        rise: (nodes,) array that gets the least upward speed of each node, m/s, with which it just lands or gets out of
            the floor.

    Returns:
        The number of these nodes.
    """
    count = 0
    for rod in range(len(bodies.length)):
        radius = bodies.radius[rod]
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            gap = motion.x[2, i] - radius
            if gap < radius:
                gap -= max(_dip(motion.x, bends, i - 1, bodies.first, rod), _dip(motion.x, bends, i, bodies.first, rod))
            rise[i] = allowed_approach(gap, step, radius)
            if not bodies.pinned[i] and gap < NEAR_FLOOR_RADII * radius + 2 * step * abs(motion.v[2, i]):
                touching[count] = i
                count += 1
                x, y, z = on_cone(*_vector(motion.floor_impulse, i), 0.0, 0.0, 1.0, friction)
            else:
                x, y, z = 0.0, 0.0, 0.0
            motion.floor_impulse[0, i], motion.floor_impulse[1, i], motion.floor_impulse[2, i] = x, y, z
    return count


@compiled
def _dip(x: Array, bends: Array, i: int, first: Integers, rod: int) -> float:
    """Compute how far the smooth curve dips below the lower end of the segment that starts at node i, m, 0 or more."""
    if i < first[rod] or i + 1 >= first[rod + 1]:
        return 0.0
    deepest = 0.0
    for t in (0.25, 0.5, 0.75):
        deepest = max(deepest, min(x[2, i], x[2, i + 1]) - point(x, bends, 2, i, t))
    return deepest


@compiled
def _vector(array: Array, i: int) -> tuple[float, float, float]:
    return array[0, i], array[1, i], array[2, i]


@compiled
def sweep_floor(  # noqa: PLR0913, PLR0917 - in nested tuples every access would count references
    bodies: Bodies,
    operator: Operator,
    floor_impulse: Array,
    rise: Array,
    touching: Integers,
    friction: float,
    sweep: int,
    small: float,
    owed: Array,
    stirred: Integers,
    v: Array,
) -> float:
    """Give each node near the floor the impulse that it needs, node after node.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        floor_impulse: (3, nodes) impulses of the floor, N s, changed in place.
        rise: (nodes,) least upward speed of each node, m/s.
        touching: numbers of the nodes that the floor may touch.
        friction: Coulomb's coefficient.
        sweep: number of the sweep in this step; every second sweep goes backwards.
        small: change of velocity, m/s, summed over a rod, up to which changes move the node alone.
        owed: (3, nodes) sum of the changes of each node's impulse, N s, that have moved it alone so far. Many of them
            would move a stiff rod as a whole, so they are passed on together.
        stirred: (stretches,) number of the sweep that last changed each stretch of nodes, changed in place. Nodes of
            stretches that neither this sweep nor the one before it has changed are left out.
        v: (3, nodes) velocities, m/s, changed in place as the impulses act.

    Returns:
        The largest change of velocity, m/s, summed over a rod.
    """
    owner, first, reach, coupling = bodies.owner, bodies.first, operator.reach, operator.coupling
    response, centre = operator.response, (operator.response.shape[1] - 1) // 2
    worst = 0.0
    for step in range(len(touching)):
        i = touching[len(touching) - 1 - step] if sweep % 2 == 1 else touching[step]
        if is_calm(stirred, i, i, sweep):
            continue
        rod = owner[i]
        compliance = response[i, centre]
        px, py, pz = floor_impulse[0, i], floor_impulse[1, i], floor_impulse[2, i]
        wx, wy, wz = px - v[0, i] / compliance, py - v[1, i] / compliance, pz - (v[2, i] - rise[i]) / compliance
        wx, wy, wz = on_cone(wx, wy, wz, 0.0, 0.0, 1.0, friction)
        floor_impulse[0, i], floor_impulse[1, i], floor_impulse[2, i] = wx, wy, wz
        dx, dy, dz = wx - px, wy - py, wz - pz
        v[0, i] -= compliance * owed[0, i]
        v[1, i] -= compliance * owed[1, i]
        v[2, i] -= compliance * owed[2, i]
        dx, dy, dz = dx + owed[0, i], dy + owed[1, i], dz + owed[2, i]
        moved = max(abs(dx), abs(dy), abs(dz)) * compliance * coupling[rod]
        if moved > small:
            low, high = max(first[rod], i - reach[rod]), min(first[rod + 1], i + reach[rod] + 1)
            push(response[i], low - i + centre, low, high - low, dx, dy, dz, v)
            stir(stirred, low, high - low, sweep)
            worst = max(worst, moved)
            owed[0, i], owed[1, i], owed[2, i] = 0.0, 0.0, 0.0
        else:
            v[0, i] += compliance * dx
            v[1, i] += compliance * dy
            v[2, i] += compliance * dz
            owed[0, i], owed[1, i], owed[2, i] = dx, dy, dz
    return worst


@compiled
def hold_on_floor(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, rod: int) -> None:
    """Place the nodes of a rod that the floor carries at their final height; mark them, and pinned nodes, as held."""
    start, held = scratch.start, scratch.held
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        held[i] = AT_REST if bodies.pinned[i] else FREE
        if motion.floor_impulse[2, i] > 0.0:
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + step * scratch.rise[i]


@compiled
def catch_sunk(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, rod: int) -> bool:
    """Hold the nodes of a rod that keeping the lengths has pressed into the floor; return whether there are any."""
    start, held = scratch.start, scratch.held
    radius, found = bodies.radius[rod], False
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        if held[i] == FREE and motion.x[2, i] < min((1 - SUNK_RADII) * radius, start[2, i]):
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + step * scratch.rise[i]
            found = True
    return found


@compiled
def let_go_pulled(bodies: Bodies, motion: Motion, scratch: Scratch, rod: int) -> bool:
    """Let go of the nodes of a rod that the floor would have to pull down; return whether there are any."""
    held, load, found = scratch.held, scratch.load, False
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        if held[i] == IN_HEIGHT and motion.floor_impulse[2, i] < 0.0:
            held[i] = FREE
            for c in range(3):
                load[c, i] -= motion.floor_impulse[c, i]
                motion.floor_impulse[c, i] = 0.0
            found = True
    return found
