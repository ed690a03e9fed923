"""The floor: which nodes it may touch, its impulses, and the heights at which it carries them."""

from worker.simulate.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import allowed_approach, is_calm, on_cone, push, stir
from worker.simulate.rod.lengths import AT_REST, FREE, IN_HEIGHT
from worker.simulate.rod.model import Array

NEAR_FLOOR_RADII = 0.25
"""Nodes that come no nearer to the floor in a step are not asked for; others may push them down, but hardly so far."""

SUNK_RADII = 0.004
"""How deep keeping the lengths may press a node into the floor before the floor is asked again."""


@compiled
def find_near_floor(
    bodies: Bodies, motion: Motion, step: float, friction: float, touching: Integers, rise: Array
) -> int:
    """Find the nodes that could reach the floor in this step; the others' impulses are forgotten.

    Args:
        bodies: the rods.
        motion: `floor_impulse` is changed.
        step: s.
        friction: Coulomb's coefficient.
        touching: (nodes,) these nodes, ascending, are set.
        rise: (nodes,) how fast they must rise at least, m/s, is set: to land just so, or to get out of the floor.

    Returns:
        How many there are.
    """
    count = 0
    for rod in range(len(bodies.length)):
        radius = bodies.radius[rod]
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            gap = motion.x[2, i] - radius
            if gap < radius:
                gap -= max(_dip(motion.x, i - 1, bodies.first, rod), _dip(motion.x, i, bodies.first, rod))
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
def _dip(x: Array, i: int, first: Integers, rod: int) -> float:
    """How far the smooth curve goes below the lower end of the segment that starts at node i, m; 0 if it does not."""
    if i < first[rod] or i + 1 >= first[rod + 1]:
        return 0.0
    here, there = x[2, i], x[2, i + 1]
    before = x[2, i - 1] if i > first[rod] else 2 * here - there
    after = x[2, i + 2] if i + 2 < first[rod + 1] else 2 * there - here
    bend, next_bend = before - 2 * here + there, here - 2 * there + after
    deepest = 0.0
    for t in (0.25, 0.5, 0.75):
        height = here + t * (there - here) - 0.5 * t * (1 - t) * ((1 - t) * bend + t * next_bend)
        deepest = max(deepest, min(here, there) - height)
    return deepest


@compiled
def _vector(array: Array, i: int) -> tuple[float, float, float]:
    return array[0, i], array[1, i], array[2, i]


@compiled
def sweep_floor(  # noqa: PLR0913, PLR0917 - out of nested tuples every access would count references
    bodies: Bodies,
    operator: Operator,
    floor_impulse: Array,
    rise: Array,
    touching: Integers,
    friction: float,
    sweep: int,
    small: float,
    stirred: Integers,
    v: Array,
) -> float:
    """Give each node near the floor the impulse that it needs, one after the other.

    Args:
        bodies: the rods.
        operator: of this time step.
        floor_impulse: (3, nodes) N s, is changed.
        rise: (nodes,) m/s, how fast nodes must rise at least.
        touching: those that the floor may touch.
        friction: Coulomb's coefficient.
        sweep: its number in this step. Every other one goes backwards.
        small: changes below that, in m/s and summed over a rod, are not carried on to other nodes.
        stirred: (stretches,) which sweep last changed a stretch of nodes. Nodes of those that this sweep and the one
            before it left alone are left out.
        v: (3, nodes) m/s, is changed by what the impulses do.

    Returns:
        The largest change, m/s, summed over a rod.
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
        moved = max(abs(dx), abs(dy), abs(dz)) * compliance * coupling[rod]
        if moved > small:
            low, high = max(first[rod], i - reach[rod]), min(first[rod + 1], i + reach[rod] + 1)
            push(response[i], low - i + centre, low, high - low, dx, dy, dz, v)
            stir(stirred, low, high - low, sweep)
            worst = max(worst, moved)
        else:
            v[0, i] += compliance * dx
            v[1, i] += compliance * dy
            v[2, i] += compliance * dz
    return worst


@compiled
def hold_on_floor(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, rod: int) -> None:
    """Place a rod's nodes that the floor carries where they end the step; mark them, and pinned ones, as held."""
    start, held = scratch.start, scratch.held
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        held[i] = AT_REST if bodies.pinned[i] else FREE
        if motion.floor_impulse[2, i] > 0.0:
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + step * scratch.rise[i]


@compiled
def catch_sunk(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, rod: int) -> bool:
    """Hold the nodes that keeping the lengths has pushed into the floor; returns whether there are any."""
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
    """Let go the nodes that the floor would have to pull; returns whether there are any."""
    held, load, found = scratch.held, scratch.load, False
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        if held[i] == IN_HEIGHT and motion.floor_impulse[2, i] < 0.0:
            held[i] = FREE
            for c in range(3):
                load[c, i] -= motion.floor_impulse[c, i]
                motion.floor_impulse[c, i] = 0.0
            found = True
    return found
