"""The solver's state as flat arrays: all nodes of all rods one after the other, coordinates in rows."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from worker.simulate.rod.model import Array, Rod

Integers = NDArray[np.int64]


class Bodies(NamedTuple):
    """What does not change: the rods' make-up.

    Attributes:
        first: (rods + 1,) number of each rod's first node, and of all nodes.
        owner: (nodes,) the rod of each node.
        mass: (nodes,) kg; half a segment's at the ends.
        curvature: (nodes,) natural curvature, 1/m.
        pinned: (nodes,) nodes that are held.
        length: (rods,) of a segment, m.
        stiffness: (rods,) EI, N m^2.
        radius: (rods,) m.
    """

    first: Integers
    owner: Integers
    mass: Array
    curvature: Array
    pinned: NDArray[np.bool_]
    length: Array
    stiffness: Array
    radius: Array


class Motion(NamedTuple):
    """What changes: where the nodes are, how fast, and what holds them.

    Attributes:
        x: (3, nodes) m.
        v: (3, nodes) m/s.
        tension: (nodes,) N in the segment that starts at each node; 0 at a rod's last node.
        floor_impulse: (3, nodes) N s of the floor on each node in the last step.
        touched: (rods,) whether anything pushed a rod in the last step.
    """

    x: Array
    v: Array
    tension: Array
    floor_impulse: Array
    touched: NDArray[np.bool_]


class Scratch(NamedTuple):
    """Room for what is computed within a step.

    Attributes:
        momentum: (3, nodes) N s, without contact and tension.
        load: (3, nodes) N s, the momentum with contact.
        v: (3, nodes) m/s, at the end of the step.
        start: (3, nodes) m, where the nodes were at the start of the step.
        bulge: (nodes,) m, how far the curve leaves the chords; see `worker.simulate.rod.narrow_phase`.
        reach: (nodes,) m, how far around each node contact is looked for; see `worker.simulate.rod.narrow_phase`.
        stirred: (stretches,) number of the sweep that last changed velocities there; see `worker.simulate.rod.contact`.
        rise: (nodes,) m/s, how fast nodes near the floor must rise at least.
        near_floor: (nodes,) the nodes that the floor may touch, the first ones of these.
        held: (nodes,) which nodes lengths are kept against; see `worker.simulate.rod.lengths`.
        system: for the equations of `worker.simulate.rod.lengths`.
    """

    momentum: Array
    load: Array
    v: Array
    start: Array
    bulge: Array
    reach: Array
    stirred: Integers
    rise: Array
    near_floor: Integers
    held: NDArray[np.int8]
    system: Array


def flatten(rods: Sequence[Rod]) -> tuple[Bodies, Motion]:
    """The rods at rest where they start."""
    counts = [len(rod.nodes_m) for rod in rods]
    nodes = int(np.sum(counts))
    length = np.array([rod.segment_length_m for rod in rods])
    masses, curvatures, pinned = [], [], []
    for rod, count in zip(rods, counts, strict=True):
        mass = np.full(count, rod.mass_per_length_kg_m * rod.segment_length_m)
        mass[[0, -1]] *= 0.5
        masses.append(mass)
        curvatures.append(np.zeros(count) if rod.natural_curvature_per_m is None else rod.natural_curvature_per_m)
        pinned.append(np.zeros(count, np.bool_) if rod.pinned is None else rod.pinned)
    bodies = Bodies(
        first=np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
        owner=np.repeat(np.arange(len(rods)), counts).astype(np.int64),
        mass=np.concatenate(masses),
        curvature=np.concatenate(curvatures),
        pinned=np.concatenate(pinned),
        length=length,
        stiffness=np.array([rod.bending_stiffness_n_m2 for rod in rods]),
        radius=np.array([rod.radius_m for rod in rods]),
    )
    motion = Motion(
        x=np.ascontiguousarray(np.concatenate([rod.nodes_m for rod in rods]).T),
        v=np.zeros((3, nodes)),
        tension=np.zeros(nodes),
        floor_impulse=np.zeros((3, nodes)),
        touched=np.zeros(len(rods), np.bool_),
    )
    return bodies, motion
