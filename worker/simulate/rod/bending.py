"""Bending: the implicit operator A = M + h (h + tau) K of each rod, its factors, and its response to a push.

K is the second derivative of the bending energy sum(EI / (2 l^3) |x[i-1] - 2 x[i] + x[i+1]|^2). For an inextensible rod
this energy is quadratic without approximation (Bergou et al. 2006, "A quadratic bending model for inextensible
surfaces"). So A is the same in x, y and z and for the whole fall, and is factored once.
"""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies, Integers
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

NEGLIGIBLE_RESPONSE = 0.01
"""Share of the response to a push, that of the farthest nodes, that sweeps over contacts leave out; after each round of
sweeps the impulses act in full."""


class Operator(NamedTuple):
    """The operator A for one time step.

    Attributes:
        step: time step h, s.
        bands: (3, nodes) diagonal of A and the two diagonals above it, kg.
        factors: (3, nodes) factors of A = L D L^T: 1/D, and the two diagonals of L below its main one.
        reach: (rods,) number of nodes on either side of a push that respond to it.
        coupling: (rods,) sum of all nodes' changes of velocity when a push changes that of its own node by one.
        response: (nodes, 2 max(reach) + 1) velocity per impulse of the nodes around a pushed node, 1/kg.
    """

    step: float
    bands: Array
    factors: Array
    reach: Integers
    coupling: Array
    response: Array


@compiled
def _assemble(bodies: Bodies, factor: float, bands: Array) -> None:
    bands[:] = 0.0
    for rod in range(len(bodies.length)):
        k = factor * bodies.stiffness[rod] / bodies.length[rod] ** 3
        first, end = bodies.first[rod], bodies.first[rod + 1]
        for i in range(first, end):
            bands[0, i] += bodies.mass[i]
        for i in range(first + 1, end - 1):
            bands[0, i - 1] += k
            bands[0, i] += 4 * k
            bands[0, i + 1] += k
            bands[1, i - 1] -= 2 * k
            bands[1, i] -= 2 * k
            bands[2, i - 1] += k
        for i in range(first, end):
            if bodies.pinned[i]:
                bands[0, i] = 1.0
                bands[1, i] = 0.0
                bands[2, i] = 0.0
                if i > first:
                    bands[1, i - 1] = 0.0
                if i > first + 1:
                    bands[2, i - 2] = 0.0


@compiled
def _factor(bodies: Bodies, bands: Array, factors: Array) -> None:
    """Factor a symmetric pentadiagonal matrix into L D L^T, rod by rod."""
    for rod in range(len(bodies.length)):
        first, end = bodies.first[rod], bodies.first[rod + 1]
        d1 = d2 = 0.0
        l1_before = 0.0
        for i in range(first, end):
            l1 = l2 = 0.0
            d = bands[0, i]
            if i > first + 1:
                l2 = bands[2, i - 2] / d2
                d -= l2 * l2 * d2
            if i > first:
                coupling = bands[1, i - 1]
                if i > first + 1:
                    coupling -= l2 * d2 * l1_before
                l1 = coupling / d1
                d -= l1 * l1 * d1
            factors[0, i] = 1.0 / d
            factors[1, i] = l1
            factors[2, i] = l2
            d2, d1, l1_before = d1, d, l1


@compiled
def solve(bodies: Bodies, factors: Array, rod: int, right: Array) -> None:
    """Multiply the columns of `right` (3, nodes) that belong to a rod by A^-1, in place."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    for i in range(first + 1, end):
        l1, l2 = factors[1, i], factors[2, i]
        two = i - 2 if i - 2 >= first else first
        for c in range(3):
            right[c, i] -= l1 * right[c, i - 1] + l2 * right[c, two]
    for i in range(first, end):
        for c in range(3):
            right[c, i] *= factors[0, i]
    for i in range(end - 2, first - 1, -1):
        l1 = factors[1, i + 1]
        l2 = factors[2, i + 2] if i + 2 < end else 0.0
        two = i + 2 if i + 2 < end else end - 1
        for c in range(3):
            right[c, i] -= l1 * right[c, i + 1] + l2 * right[c, two]


@compiled
def _unit_response(bodies: Bodies, factors: Array, rod: int, node: int, column: Array) -> None:
    first, end = bodies.first[rod], bodies.first[rod + 1]
    column[:] = 0.0
    if bodies.pinned[node]:
        return
    column[node - first] = 1.0
    for i in range(node + 1, end):
        j = i - first
        before = column[j - 2] if j >= 2 else 0.0
        column[j] -= factors[1, i] * column[j - 1] + factors[2, i] * before
    for i in range(first, end):
        column[i - first] *= factors[0, i]
    for i in range(end - 2, first - 1, -1):
        j = i - first
        after = factors[2, i + 2] * column[j + 2] if i + 2 < end else 0.0
        column[j] -= factors[1, i + 1] * column[j + 1] + after


@compiled
def _reach(bodies: Bodies, factors: Array, reach: Integers, coupling: Array) -> None:
    """Find `reach`, beyond which the response to a push is negligible, and `coupling`, in place.

    A push on the rod's middle tells, unless even the ends answer it: then all nodes count.
    """
    for rod in range(len(bodies.length)):
        first, end = bodies.first[rod], bodies.first[rod + 1]
        middle = (first + end) // 2
        while bodies.pinned[middle] and middle + 1 < end:
            middle += 1
        column = np.zeros(end - first)
        _unit_response(bodies, factors, rod, middle, column)
        # Many pushes on a stiff rod add up, so the sum of the responses that are left out must be small.
        own = abs(column[middle - first])
        # A rod that is pinned all along answers no push.
        coupling[rod] = np.abs(column).sum() / own if own > 0.0 else 0.0
        left_out = NEGLIGIBLE_RESPONSE * np.abs(column).sum()
        far = end - first - 1
        while far > 2:
            for j in (middle - first - far, middle - first + far):
                if 0 <= j < end - first:
                    left_out -= abs(column[j])
            if left_out < 0.0:
                break
            far -= 1
        # Where even the ends respond to a push on the middle, one end responds to a push on the other.
        is_short = far >= min(middle - first, end - 1 - middle)
        reach[rod] = end - first - 1 if own > 0.0 and is_short else far


@compiled
def _respond(bodies: Bodies, factors: Array, reach: Integers, response: Array) -> None:
    centre = (response.shape[1] - 1) // 2
    for rod in range(len(bodies.length)):
        first, end = bodies.first[rod], bodies.first[rod + 1]
        column = np.zeros(end - first)
        for node in range(first, end):
            _unit_response(bodies, factors, rod, node, column)
            for j in range(max(first, node - reach[rod]), min(end, node + reach[rod] + 1)):
                response[node, j - node + centre] = column[j - first]


def operator_for(bodies: Bodies, step_s: float, damping_s: float) -> Operator:
    """Factor A for a time step, and tabulate the response to pushes.

    Args:
        bodies: the rods.
        step_s: time step h, s.
        damping_s: time constant tau of the internal damping, s.
    """
    nodes = len(bodies.mass)
    bands, factors = np.zeros((3, nodes)), np.zeros((3, nodes))
    reach = np.zeros(len(bodies.length), np.int64)
    _assemble(bodies, step_s * (step_s + damping_s), bands)
    _factor(bodies, bands, factors)
    coupling = np.zeros(len(bodies.length))
    _reach(bodies, factors, reach, coupling)
    response = np.zeros((nodes, 2 * int(reach.max()) + 1))
    _respond(bodies, factors, reach, response)
    return Operator(step=step_s, bands=bands, factors=factors, reach=reach, coupling=coupling, response=response)


@compiled
def energy_of(bodies: Bodies, bands: Array, v: Array) -> float:
    """Compute v A v / 2, J, of velocities (3, nodes): kinetic energy, and the energy that bending takes in a step."""
    total = 0.0
    for rod in range(len(bodies.length)):
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            for c in range(3):
                row = 0.5 * bands[0, i] * v[c, i]
                if i + 1 < bodies.first[rod + 1]:
                    row += bands[1, i] * v[c, i + 1]
                if i + 2 < bodies.first[rod + 1]:
                    row += bands[2, i] * v[c, i + 2]
                total += row * v[c, i]
    return total
