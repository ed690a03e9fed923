"""The input of the rod solver: rods, and the surroundings in which they fall. All units are SI."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.scene.physics import GRAVITY_M_S2

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rod:
    """One round, inextensible, elastic rod.

    Attributes:
        nodes_m: (N, 3) metres, N >= 4, places of the nodes at the start. All segments have the length of the first.
        radius_m: radius of the section, in metres.
        youngs_modulus_pa: Young's modulus E, in pascals; the bending stiffness is E pi r^4 / 4.
        density_kg_m3: density rho, in kg/m3; the mass per length is rho pi r^2.
        natural_curvature_per_m: (N,) natural curvature about the vertical axis, in 1/m, anticlockwise seen from above:
            tan(theta) / l at each node, with theta the angle between its segments and l their length. None is straight.
        pinned: (N,) whether a node is held in its place; None holds no node.
        pull_n: (N, 3) constant force on each node, in newtons; None pulls at no node.
        inertia: inertia over mass, at least 1. Above 1, gravity and wind act on the inertia until the rod first touches
            something, so that it falls as any rod does, and on its mass from then on. At rest it makes no difference.
    """

    nodes_m: Array
    radius_m: float
    youngs_modulus_pa: float
    density_kg_m3: float
    natural_curvature_per_m: Array | None = None
    pinned: NDArray[np.bool_] | None = None
    pull_n: Array | None = None
    inertia: float = 1.0

    @property
    def bending_stiffness_n_m2(self) -> float:
        """Bending stiffness EI of the full round section, in N m^2."""
        return float(self.youngs_modulus_pa * np.pi * self.radius_m**4 / 4)

    @property
    def mass_per_length_kg_m(self) -> float:
        """Mass per length, in kg/m: density times the area of the section."""
        return float(self.density_kg_m3 * np.pi * self.radius_m**2)

    @property
    def segment_length_m(self) -> float:
        """Length of each segment, in metres."""
        return float(np.linalg.norm(self.nodes_m[1] - self.nodes_m[0]))


@dataclass(frozen=True, slots=True)
class Breeze:
    """A wind that is the same everywhere, and dies down.

    Attributes:
        velocity_m_s: (3,) mean velocity of the air, in m/s.
        gusts: (K, 3) amplitude as a share of the mean, angular frequency in rad/s and phase in rad of each oscillation.
        until_s: time at which the wind begins to die down, in seconds; it is calm 0.1 s later.
    """

    velocity_m_s: Array
    gusts: Array
    until_s: float


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The forces and surfaces that act on the rods.

    Attributes:
        gravity_m_s2: gravity (x, y, z), in m/s2.
        floor: whether there is a floor at z = 0.
        friction_floor: Coulomb's coefficient of friction between a rod and the floor.
        friction_rods: Coulomb's coefficient of friction between two rods.
        damping_s: time constant of the internal damping (Kelvin-Voigt), in seconds: the bending stress is
            E (strain + damping_s * strain rate).
        resistance: dry resistance to any motion of a rod that touches something, as a share of its weight. It stands
            for rolling and for the friction between a cable's strands; without it a rod that rocks on another never
            stops.
        breeze: wind; None for still air without drag.
    """

    gravity_m_s2: tuple[float, float, float] = (0.0, 0.0, -GRAVITY_M_S2)
    floor: bool = True
    friction_floor: float = 0.4
    friction_rods: float = 0.3
    damping_s: float = 0.0
    resistance: float = 0.0
    breeze: Breeze | None = None
