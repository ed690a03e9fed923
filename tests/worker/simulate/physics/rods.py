"""Rods, measurements and numbers that the physics tests share."""

from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.shapes import CableShapes

RADIUS_M = 0.001
DENSITY_KG_M3 = 1500.0
MODULUS_PA = 1e7
GRAVITY_M_S2 = 9.81

WEIGHTLESS = Surroundings(gravity_m_s2=(0.0, 0.0, 0.0), floor=False)
IN_THE_AIR = Surroundings(floor=False)
"""Surroundings with gravity and nothing else."""


def line(start: Iterable[float], end: Iterable[float], segments: int) -> Array:
    """Nodes of a straight rod."""
    nodes: Array = np.linspace(np.array(list(start), float), np.array(list(end), float), segments + 1)
    return nodes


def rod(
    nodes_m: Array,
    *,
    radius_m: float = RADIUS_M,
    modulus_pa: float = MODULUS_PA,
    density_kg_m3: float = DENSITY_KG_M3,
    natural_curvature_per_m: Array | None = None,
    pinned: Iterable[int] = (),
) -> Rod:
    """A rod; `pinned` holds numbers of nodes, negative ones counted from the end."""
    held = np.zeros(len(nodes_m), np.bool_)
    held[list(pinned)] = True
    return Rod(
        nodes_m=nodes_m,
        radius_m=radius_m,
        youngs_modulus_pa=modulus_pa,
        density_kg_m3=density_kg_m3,
        natural_curvature_per_m=natural_curvature_per_m,
        pinned=held,
    )


def curve_m(nodes_m: Array, parts: int) -> Array:
    """Points (n, 3) on the Catmull-Rom curve through nodes, `parts` per segment; beyond the ends it is straight."""
    before, after = 2 * nodes_m[:1] - nodes_m[1:2], 2 * nodes_m[-1:] - nodes_m[-2:-1]
    p = np.concatenate([before, nodes_m, after])[:, None]
    p0, p1, p2, p3 = p[:-3], p[1:-2], p[2:-1], p[3:]
    t = np.arange(parts)[:, None] / parts
    cubic = 2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2 + (3 * p1 - p0 - 3 * p2 + p3) * t**3
    return np.concatenate([cubic.reshape(-1, 3) / 2, nodes_m[-1:]])


def modulus_pa(slenderness: float, length_m: float) -> float:
    """Young's modulus at which 4 rho g L^3 / (E r^2) is the slenderness."""
    return 4 * DENSITY_KG_M3 * GRAVITY_M_S2 * length_m**3 / (slenderness * RADIUS_M**2)


def weight_per_length_n_m(one: Rod) -> float:
    """Weight per length of a rod under the tests' gravity."""
    return one.mass_per_length_kg_m * GRAVITY_M_S2


def shapes(simulation: RodSimulation, rods: Iterable[Rod], order: tuple[int, ...] | None = None) -> CableShapes:
    """The rods of a simulation as the gates take them; they start in ascending order unless another is given."""
    rods = list(rods)
    numbers = range(len(rods))
    return CableShapes(
        nodes_m=tuple(simulation.nodes_m(k) for k in numbers),
        radii_m=np.array([one.radius_m for one in rods]),
        lengths_m=np.array([one.segment_length_m * (len(one.nodes_m) - 1) for one in rods]),
        speeds_m_s=tuple(np.linalg.norm(simulation.velocities_m_s(k), axis=1) for k in numbers),
        start_order=order or tuple(numbers),
        fall_s=simulation.time_s,
        steps=simulation.steps,
    )


def masses_kg(one: Rod) -> NDArray[np.float64]:
    """Masses of a rod's nodes, half a segment's at the ends."""
    mass = np.full(len(one.nodes_m), one.mass_per_length_kg_m * one.segment_length_m)
    mass[[0, -1]] /= 2
    return mass


def angular_frequency_rad_s(simulation: RodSimulation, reading: Callable[[Array], float], *, steps: int) -> float:
    """Angular frequency of a reading of the first rod's nodes that swings about zero, over the last whole period."""
    readings = np.empty(steps)
    for step in range(steps):
        simulation.advance(1)
        readings[step] = reading(simulation.nodes_m(0))
    before = np.flatnonzero(np.sign(readings[1:]) != np.sign(readings[:-1]))
    crossings = before + readings[before] / (readings[before] - readings[before + 1])
    return float(2 * np.pi / ((crossings[-1] - crossings[-3]) * simulation.step_s))
