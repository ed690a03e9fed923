"""What the rod solver takes: rods, and the world that they fall in. SI units throughout."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rod:
    """One round, inextensible, elastic rod.

    Attributes:
        nodes_m: (N, 3), N >= 3: where it starts. All segments have the length of the first.
        radius_m: of its section.
        youngs_modulus_pa: its bending stiffness is E pi r^4 / 4.
        density_kg_m3: its mass per length is rho pi r^2.
        natural_curvature_per_m: (N,) 1/m about the vertical axis, anticlockwise from above along the rod; None: straight.
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
        return self.youngs_modulus_pa * np.pi * self.radius_m**4 / 4

    @property
    def mass_per_length_kg_m(self) -> float:
        """Rho A."""
        return self.density_kg_m3 * np.pi * self.radius_m**2

    @property
    def segment_length_m(self) -> float:
        """Rest length of each segment."""
        return float(np.linalg.norm(self.nodes_m[1] - self.nodes_m[0]))
