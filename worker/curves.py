"""Smooth curves through nodes: the centrelines that are rendered, labelled and measured."""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Points = NDArray[np.float64]


def smooth(nodes: Points, samples_per_span: int) -> Points:
    """A twice continuously differentiable curve through nodes.

    Args:
        nodes: (N, 3), N >= 2.
        samples_per_span: number of spans of the curve between two nodes, >= 1.

    Returns:
        ((N - 1) * samples_per_span + 1, 3), through every node.
    """
    parameter = np.arange(len(nodes))
    fine = np.linspace(0, len(nodes) - 1, (len(nodes) - 1) * samples_per_span + 1)
    curve: Points = CubicSpline(parameter, nodes)(fine)
    return curve


def tangents(curve: Points) -> Points:
    """Unit tangents of a finely sampled curve (N, 3), by central differences."""
    difference = np.gradient(curve, axis=0)
    unit: Points = difference / np.linalg.norm(difference, axis=1, keepdims=True)
    return unit


def parts_near(curve: Points, half_edge_m: float) -> list[slice]:
    """The parts of a curve within a square about the z axis.

    Args:
        curve: (N, 3).
        half_edge_m: half the square's edge.

    Returns:
        The indices of each part, with one more point on either side where the curve goes on.
    """
    inside = (np.abs(curve[:, :2]) <= half_edge_m).all(axis=1)
    inside[1:] |= inside[:-1].copy()
    inside[:-1] |= inside[1:].copy()
    changes = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(np.int8)))
    return [slice(int(a), int(b)) for a, b in zip(changes[::2], changes[1::2], strict=True) if b - a > 1]
