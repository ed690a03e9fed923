"""The floor: which nodes it may touch, its impulses, and the heights at which it carries them."""

import numpy as np

from worker.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.rod.bending import Operator
from worker.rod.compiled import compiled
from worker.rod.contact import SMALL_CHANGE_M_S, allowed_approach, project_on_cone
from worker.rod.lengths import AT_REST, FREE, IN_HEIGHT
from worker.rod.model import Array

SUNK_RADII = 0.02
"""How deep keeping the lengths may press a node into the floor before the floor is asked again."""


@compiled
def find_near_floor(bodies: Bodies, motion: Motion, step: float, friction: float, touching: Integers) -> int:
    """Nodes that could reach the floor in this step; the others' impulses are forgotten."""
    count = 0
    up = np.array([0.0, 0.0, 1.0])
    for i in range(len(bodies.owner)):
        gap = motion.x[2, i] - bodies.radius[bodies.owner[i]]
        if not bodies.pinned[i] and gap < bodies.radius[bodies.owner[i]] + 2 * step * abs(motion.v[2, i]):
            touching[count] = i
            count += 1
            project_on_cone(motion.floor_impulse[:, i], up, friction)
        else:
            motion.floor_impulse[:, i] = 0.0
    return count


@compiled
def _push(bodies: Bodies, operator: Operator, node: int, impulse: Array, v: Array) -> None:
    """Add what an impulse on a node does to the velocities of its rod."""
    rod = bodies.owner[node]
    reach = operator.reach[rod]
    centre = (operator.response.shape[1] - 1) // 2
    low, high = max(bodies.first[rod], node - reach), min(bodies.first[rod + 1], node + reach + 1)
    shift = centre - node
    for c in range(3):
        p = impulse[c]
        if p != 0.0:
            for j in range(low, high):
                v[c, j] += p * operator.response[node, j + shift]


@compiled
def sweep_floor(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    start: Array,
    touching: Integers,
    friction: float,
    sweep: int,
    stirred: Integers,
    v: Array,
) -> float:
    """One pass over all nodes near the floor; returns the largest change, m/s, summed over a rod."""
    worst = 0.0
    centre = (operator.response.shape[1] - 1) // 2
    change, wanted = np.empty(3), np.empty(3)
    up = np.array([0.0, 0.0, 1.0])
    for step in range(len(touching)):
        node = touching[len(touching) - 1 - step] if sweep % 2 == 1 else touching[step]
        rod = bodies.owner[node]
        if stirred[rod] < sweep - 1:
            continue
        compliance = operator.response[node, centre]
        radius = bodies.radius[rod]
        gap = start[2, node] - radius
        approach = allowed_approach(gap, operator.step, radius)
        impulse = motion.floor_impulse[:, node]
        for c in range(3):
            wanted[c] = impulse[c] - v[c, node] / compliance
        wanted[2] += approach / compliance
        project_on_cone(wanted, up, friction)
        moved = 0.0
        for c in range(3):
            change[c] = wanted[c] - impulse[c]
            impulse[c] = wanted[c]
            moved = max(moved, abs(change[c]))
        moved *= compliance * operator.coupling[rod]
        if moved <= SMALL_CHANGE_M_S:
            for c in range(3):
                v[c, node] += compliance * change[c]
        else:
            _push(bodies, operator, node, change, v)
            stirred[rod] = sweep
            worst = max(worst, moved)
    return worst


@compiled
def hold_on_floor(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, touching: Integers) -> None:
    """Place the nodes that the floor carries where they end the step; mark them, and pinned ones, as held."""
    start, held = scratch.start, scratch.held
    for i in range(len(held)):
        held[i] = AT_REST if bodies.pinned[i] else FREE
    for i in touching:
        if motion.floor_impulse[2, i] > 0.0:
            radius = bodies.radius[bodies.owner[i]]
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + step * allowed_approach(start[2, i] - radius, step, radius)


@compiled
def catch_sunk(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, rod: int) -> bool:
    """Hold the nodes that keeping the lengths has pushed into the floor; returns whether there are any."""
    start, held = scratch.start, scratch.held
    radius, found = bodies.radius[rod], False
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        if held[i] == FREE and motion.x[2, i] < min((1 - SUNK_RADII) * radius, start[2, i]):
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + step * allowed_approach(start[2, i] - radius, step, radius)
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
