"""The solver's state as flat arrays: the nodes of all rods, rod after rod, with a row for each coordinate."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from worker.simulate.rod.model import Array, Rod

Integers = NDArray[np.int64]

LEAST_NODES = 4
"""Least number of a rod's nodes: a contact acts on four at either side."""


BY_NO_IMPULSE = -1.0
"""Compliance of a contact that no sweep has needed yet: most near pairs never push."""


class Bodies(NamedTuple):
    """The properties of the rods, which do not change.

    Attributes:
        first: (rods + 1,) number of each rod's first node; last the number of nodes.
        owner: (nodes,) number of each node's rod.
        mass: (nodes,) inertia of each node, kg; an end has half of a segment's.
        curvature: (nodes,) natural curvature, 1/m.
        pinned: (nodes,) whether a node is held in its place.
        pull: (3, nodes) constant force on each node, N.
        length: (rods,) length of a rod's segments, m.
        stiffness: (rods,) bending stiffness EI, N m^2.
        radius: (rods,) radius, m.
        inertia: (rods,) inertia over mass.
    """

    first: Integers
    owner: Integers
    mass: Array
    curvature: Array
    pinned: NDArray[np.bool_]
    pull: Array
    length: Array
    stiffness: Array
    radius: Array
    inertia: Array


class Motion(NamedTuple):
    """The state of the rods, which changes from step to step.

    Attributes:
        x: (3, nodes) places of the nodes, m.
        v: (3, nodes) velocities of the nodes, m/s.
        tension: (nodes,) tension of the segment that starts at each node, N; 0 at a rod's last node.
        floor_impulse: (3, nodes) impulse of the floor on each node in the last step, N s.
        touched: (rods,) whether the floor or another rod pushed a rod in the last step.
        landed: (rods,) whether one of them ever has.
        anchor: (3, nodes) places of the nodes when they last had moved too far to rest, m.
    """

    x: Array
    v: Array
    tension: Array
    floor_impulse: Array
    touched: NDArray[np.bool_]
    landed: NDArray[np.bool_]
    anchor: Array


class Scratch(NamedTuple):
    """Arrays for the values that a step computes.

    Attributes:
        momentum: (3, nodes) momentum at the end of the step without contact and tension, N s.
        load: (3, nodes) that momentum with the impulses of contacts, N s.
        v: (3, nodes) velocities at the end of the step, m/s.
        last: (3, nodes) those velocities before the present turn, m/s.
        before: (3, nodes) velocities at the start of the step, m/s.
        start: (3, nodes) places of the nodes at the start of the step, m.
        bends: (3, nodes) second derivatives of the curves at the nodes, m; see `worker.simulate.rod.curves`.
        bulge: (nodes,) largest distance of the curve from its chords, m; see `worker.simulate.rod.curves`.
        reach: (nodes,) distance around each node within which contact is looked for, m; see
            `worker.simulate.rod.narrow_phase`.
        stirred: (stretches,) number of the sweep that last changed velocities in a stretch of nodes; see
            `worker.simulate.rod.contact`.
        owed: (3, nodes) impulses of the floor that sweeps have yet to pass on, N s; see `worker.simulate.rod.floor`.
        rise: (nodes,) least upward speed of the nodes near the floor, m/s.
        near_floor: (nodes,) numbers of the nodes that the floor may touch, at the beginning of the array.
        held: (nodes,) whether and how a node is held while lengths are kept; see `worker.simulate.rod.lengths`.
        system: arrays for the equations of `worker.simulate.rod.lengths`.
    """

    momentum: Array
    load: Array
    v: Array
    last: Array
    before: Array
    start: Array
    bends: Array
    bulge: Array
    reach: Array
    stirred: Integers
    owed: Array
    rise: Array
    near_floor: Integers
    held: NDArray[np.int8]
    system: Array


class Contacts(NamedTuple):
    """The contacts of one step, at the beginning of arrays with room for n. Each contact has two sides, a segment each.

    Attributes:
        pair: (n,) number of the contact's candidate pair.
        segment: (2, n) number of each side's first node.
        at: (2, n) place on each segment that is closest to the other one, as a share of its length, 0 to 1.
        base: (2, n) number of the first of the four nodes on which each side acts.
        weights: (2, n, 4) weights of these nodes.
        normal: (n, 3) unit vector from the second side to the first.
        approach: (n,) least relative speed of the first side along the normal, m/s; -inf if the contact never pushes.
        compliance: (n,) relative velocity per impulse, 1/kg; BY_NO_IMPULSE until a sweep needs it and what follows; 0
            if the contact never pushes.
        own: (2, n) velocity per impulse of each side, 1/kg.
        low: (2, n) number of the first node that responds to an impulse.
        width: (2, n) number of nodes that respond.
        column: (2, n, max) velocity per impulse of these nodes, 1/kg.
    """

    pair: Integers
    segment: Integers
    at: Array
    base: Integers
    weights: Array
    normal: Array
    approach: Array
    compliance: Array
    own: Array
    low: Integers
    width: Integers
    column: Array


def flatten(rods: Sequence[Rod]) -> tuple[Bodies, Motion]:
    """Put rods into flat arrays, at rest in their starting places.

    Raises:
        ValueError: if a rod has fewer nodes than `LEAST_NODES`.
    """
    counts = [len(rod.nodes_m) for rod in rods]
    if min(counts) < LEAST_NODES:
        raise ValueError(f"a rod has {min(counts)} nodes; it needs {LEAST_NODES}")
    nodes = int(np.sum(counts))
    length = np.array([rod.segment_length_m for rod in rods])
    masses, curvatures, pinned, pulls = [], [], [], []
    for rod, count in zip(rods, counts, strict=True):
        mass = np.full(count, rod.inertia * rod.mass_per_length_kg_m * rod.segment_length_m)
        mass[[0, -1]] *= 0.5
        masses.append(mass)
        curvatures.append(np.zeros(count) if rod.natural_curvature_per_m is None else rod.natural_curvature_per_m)
        pinned.append(np.zeros(count, np.bool_) if rod.pinned is None else rod.pinned)
        pulls.append(np.zeros((count, 3)) if rod.pull_n is None else rod.pull_n)
    bodies = Bodies(
        first=np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
        owner=np.repeat(np.arange(len(rods)), counts).astype(np.int64),
        mass=np.concatenate(masses),
        curvature=np.concatenate(curvatures),
        pinned=np.concatenate(pinned),
        pull=np.ascontiguousarray(np.concatenate(pulls).T),
        length=length,
        stiffness=np.array([rod.bending_stiffness_n_m2 for rod in rods]),
        radius=np.array([rod.radius_m for rod in rods]),
        inertia=np.array([rod.inertia for rod in rods]),
    )
    motion = Motion(
        x=np.ascontiguousarray(np.concatenate([rod.nodes_m for rod in rods]).T),
        v=np.zeros((3, nodes)),
        tension=np.zeros(nodes),
        floor_impulse=np.zeros((3, nodes)),
        touched=np.zeros(len(rods), np.bool_),
        landed=np.zeros(len(rods), np.bool_),
        anchor=np.ascontiguousarray(np.concatenate([rod.nodes_m for rod in rods]).T),
    )
    return bodies, motion
