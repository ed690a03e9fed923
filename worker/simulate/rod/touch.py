"""The contacts of a step as a whole: what they bear, what they miss, and the energy that they give."""

from typing import NamedTuple

from worker.simulate.rod.arrays import Bodies, Contacts, Integers, Motion
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array


class Touch(NamedTuple):
    """The contacts of this step, between rods and with the floor.

    Loops take its parts as arguments: compiled code would count references at every access to a nested tuple.

    Attributes:
        contacts: contacts between rods, at the beginning of their arrays.
        pairs: number of contacts between rods.
        impulse: (candidates, 3) impulse of each pair that may touch, N s.
        floor: numbers of the nodes that the floor may touch.
    """

    contacts: Contacts
    pairs: int
    impulse: Array
    floor: Integers


@compiled
def work_of_depenetration(motion: Motion, touch: Touch, rise: Array) -> float:
    """Bound the work, J, by which the impulses of a step push apart rods and floor that have cut into each other."""
    contacts, total = touch.contacts, 0.0
    for n in range(touch.pairs):
        if contacts.approach[n] > 0.0:
            normal, impulse = contacts.normal[n], touch.impulse[contacts.pair[n]]
            along = impulse[0] * normal[0] + impulse[1] * normal[1] + impulse[2] * normal[2]
            total += contacts.approach[n] * along
    for i in touch.floor:
        total += max(rise[i], 0.0) * motion.floor_impulse[2, i]
    return total


@compiled
def find_touched(bodies: Bodies, motion: Motion, touch: Touch) -> None:
    """Note in `motion` which rods the floor or another rod has pushed in this step, and which have landed.

    A rod lands on the floor, on a pinned rod, or on a rod that has landed. One that touches itself goes on falling.
    """
    motion.touched[:] = False
    for i in touch.floor:
        if motion.floor_impulse[2, i] > 0.0:
            motion.touched[bodies.owner[i]] = motion.landed[bodies.owner[i]] = True
    for n in range(touch.pairs):
        push = touch.impulse[touch.contacts.pair[n]]
        if push[0] != 0.0 or push[1] != 0.0 or push[2] != 0.0:
            i, j = touch.contacts.base[0, n], touch.contacts.base[1, n]
            one, other = bodies.owner[i], bodies.owner[j]
            if one != other:
                motion.touched[one] = motion.touched[other] = True
                if motion.landed[one] or motion.landed[other] or bodies.pinned[i] or bodies.pinned[j]:
                    motion.landed[one] = motion.landed[other] = True


@compiled
def worst_miss(contacts: Contacts, pairs: int, v: Array) -> float:
    """Compute the largest excess of an approach over what its contact allows, m/s, 0 or more.

    Args:
        contacts: contacts between rods, at the beginning of their arrays.
        pairs: number of contacts.
        v: (3, nodes) velocities, m/s.
    """
    base, weights, normal = contacts.base, contacts.weights, contacts.normal
    worst = 0.0
    for n in range(pairs):
        i, j = base[0, n], base[1, n]
        along = 0.0
        for k in range(4):
            a, b = weights[0, n, k], weights[1, n, k]
            for c in range(3):
                along += normal[n, c] * (a * v[c, i + k] - b * v[c, j + k])
        worst = max(worst, contacts.approach[n] - along)
    return worst
