"""A free chain of rigid links in a plane, integrated in its links' bearings: a reference for a rod that unbends.

With theta the bearings of n links of length l, and S the matrix that sums links to nodes, the nodes are
x = x0 + l S (cos(theta), sin(theta)). Their centre of mass rests. With G = l^2 S^T (M - m m^T / sum(m)) S, Lagrange's
equations are

    sum_j G_ij (cos(theta_i - theta_j) theta_j'' + sin(theta_i - theta_j) theta_j'^2) = -dV/dtheta_i + Q_i,

with V = EI / l sum(1 - cos(turn)) over the turns between links, which is EI / 2 times the integral of the squared
curvature up to order l^2. The internal damping's power is EI tau / l sum(|b'|^2), b the difference of consecutive
links' directions; Q follows from it. Lengths hold by construction, so there are no tensions.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from worker.simulate.rod.model import Array


@dataclass(frozen=True, slots=True)
class PlanarChain:
    """A chain that is straight without stress.

    Attributes:
        masses_kg: (n + 1,) masses of the nodes.
        link_m: length of a link.
        bending_stiffness_n_m2: bending stiffness EI.
        damping_s: time constant tau of the internal damping.
    """

    masses_kg: Array
    link_m: float
    bending_stiffness_n_m2: float
    damping_s: float = 0.0

    def accelerations(self, bearings_rad: Array, rates_rad_s: Array) -> Array:
        """The second derivatives (n,) of the links' bearings (n,), in rad/s^2, at their rates (n,)."""
        difference = bearings_rad[:, None] - bearings_rad[None, :]
        inertia = self._inertia()
        stiffness = self.bending_stiffness_n_m2 / self.link_m
        along = np.stack([np.cos(bearings_rad), np.sin(bearings_rad)], axis=1)
        across = np.stack([-along[:, 1], along[:, 0]], axis=1)
        bend = along + self.damping_s * rates_rad_s[:, None] * across
        pull = np.zeros(len(bearings_rad))
        # The energy of a turn is EI / 2l |b|^2, so b and tau b' pull at either of its links.
        moment = stiffness * np.diff(bend, axis=0)
        pull[:-1] += np.einsum("ij,ij->i", moment, across[:-1])
        pull[1:] -= np.einsum("ij,ij->i", moment, across[1:])
        pull -= (inertia * np.sin(difference)) @ rates_rad_s**2
        result: Array = np.linalg.solve(inertia * np.cos(difference), pull)
        return result

    def bearings_after(self, bearings_rad: Array, time_s: float) -> Array:
        """The bearings (n,) after a time, released at rest from others; the integration errs by 1e-9 or so."""
        links = len(bearings_rad)

        def rates(_: float, state: Array) -> Array:
            return np.concatenate([state[links:], self.accelerations(state[:links], state[links:])])

        start = np.concatenate([bearings_rad, np.zeros(links)])
        found = solve_ivp(rates, (0.0, time_s), start, method="LSODA", rtol=1e-9, atol=1e-10)
        bearings: Array = found.y[:links, -1]
        return bearings

    def nodes_m(self, bearings_rad: Array) -> Array:
        """The nodes (n + 1, 2) about their centre of mass."""
        return self._centred(self.link_m * np.stack([np.cos(bearings_rad), np.sin(bearings_rad)], axis=1))

    def node_accelerations_m_s2(self, bearings_rad: Array) -> Array:
        """The accelerations (n + 1, 2) of the nodes of a chain at rest."""
        across = np.stack([-np.sin(bearings_rad), np.cos(bearings_rad)], axis=1)
        turning = self.accelerations(bearings_rad, np.zeros(len(bearings_rad)))
        return self._centred(self.link_m * turning[:, None] * across)

    def _centred(self, links: Array) -> Array:
        nodes = np.concatenate([np.zeros((1, 2)), np.cumsum(links, axis=0)])
        centred: Array = nodes - self.masses_kg @ nodes / self.masses_kg.sum()
        return centred

    def _inertia(self) -> Array:
        mass = self.masses_kg
        beyond = np.cumsum(mass[::-1])[::-1][1:]
        # A link moves the nodes beyond it, and two links those beyond the farther one.
        both = np.minimum(beyond[:, None], beyond[None, :])
        inertia: Array = self.link_m**2 * (both - np.outer(beyond, beyond) / mass.sum())
        return inertia
