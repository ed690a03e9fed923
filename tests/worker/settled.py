"""Settled shapes with known figures."""

import numpy as np

from worker.curves import Points
from worker.simulate.shapes import CableShapes

RADIUS = 0.001


def rod(*, y: float = 0.0, z: float = RADIUS, along_y: bool = False) -> Points:
    """A straight cable of 0.2 m in 41 nodes."""
    s = np.linspace(-0.1, 0.1, 41)
    zero = np.zeros_like(s)
    return np.stack([zero if along_y else s, s if along_y else zero + y, zero + z], axis=1)


def looped(*, step: float = 0.0) -> Points:
    """A cable with a loop of 20 mm that crosses itself once, with its end on top by `step` metres."""
    t = np.linspace(-1.0, 1.0, 81)
    rise = step * (1 + t / np.sqrt(0.3)) / 2
    return np.stack([0.02 * (t**3 - 0.3 * t) / 0.3, 0.02 * (1 - t**2), RADIUS + np.clip(rise, 0, step)], axis=1)


def shapes(
    *nodes: Points, order: tuple[int, ...] | None = None, speed: float = 0.0, radii: tuple[float, ...] | None = None
) -> CableShapes:
    """Cables at their rest length, started in the given order."""
    return CableShapes(
        nodes_m=nodes,
        radii_m=np.full(len(nodes), RADIUS) if radii is None else np.array(radii),
        lengths_m=np.array([np.linalg.norm(np.diff(each, axis=0), axis=1).sum() for each in nodes]),
        speeds_m_s=tuple(np.full(len(each), speed) for each in nodes),
        start_order=order or tuple(range(len(nodes))),
        fall_s=0.5,
        steps=50,
    )
