"""What the rod solver takes: rods, and the world that they fall in. SI units throughout."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.scene.physics import GRAVITY_M_S2

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rod:
    """One round, inextensible, elastic rod.

    Attributes:
        nodes_m: (N, 3), N >= 4: where it starts. All segments have the length of the first.
        radius_m: of its section.
        youngs_modulus_pa: its bending stiffness is E pi r^4 / 4.
        density_kg_m3: its mass per length is rho pi r^2.
        natural_curvature_per_m: (N,) about the vertical axis, anticlockwise as seen from above along the rod, as
            tan(theta) / l at each node, theta the angle between its segments and l their length; None: straight.
        pinned: (N,) which nodes are held where they start; None: none.
    """

    nodes_m: Array
    radius_m: float
    youngs_modulus_pa: float
    density_kg_m3: float
    natural_curvature_per_m: Array | None = None
    pinned: NDArray[np.bool_] | None = None

    @property
    def bending_stiffness_n_m2(self) -> float:
        """EI."""
        return float(self.youngs_modulus_pa * np.pi * self.radius_m**4 / 4)

    @property
    def mass_per_length_kg_m(self) -> float:
        """Density times section."""
        return float(self.density_kg_m3 * np.pi * self.radius_m**2)

    @property
    def segment_length_m(self) -> float:
        """Rest length of each segment."""
        return float(np.linalg.norm(self.nodes_m[1] - self.nodes_m[0]))


@dataclass(frozen=True, slots=True)
class Breeze:
    """A wind, the same everywhere, that dies down.

    Attributes:
        velocity_m_s: (3,) mean velocity of the air.
        gusts: (K, 3): share of the mean, angular frequency in rad/s and phase in rad of each swing.
        until_s: when it begins to die down; it is calm 0.1 s later.
    """

    velocity_m_s: Array
    gusts: Array
    until_s: float


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What acts on the rods.

    Attributes:
        gravity_m_s2: (x, y, z).
        floor: whether there is one, at z = 0.
        friction_floor: Coulomb's coefficient of a rod on the floor.
        friction_rods: the same between rods.
        damping_s: bending stress is E (strain + damping_s * strain rate): Kelvin and Voigt's internal damping.
        resistance: dry resistance to any motion of a rod that touches something, as a share of its weight: what rolling
            and the friction between a cable's strands take. Without it a rod that rocks upon another never stops.
        breeze: the wind, or None for still air without drag.
    """

    gravity_m_s2: tuple[float, float, float] = (0.0, 0.0, -GRAVITY_M_S2)
    floor: bool = True
    friction_floor: float = 0.4
    friction_rods: float = 0.3
    damping_s: float = 0.0
    resistance: float = 0.0
    breeze: Breeze | None = None
