"""Smooth curves through nodes: the centrelines of cables that are rendered, labelled and measured."""

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Points = NDArray[np.float64]
"""Points (N, 3), in metres unless a docstring says otherwise."""


def smooth(nodes: Points, samples_per_span: int) -> Points:
    """Interpolate a twice continuously differentiable curve through nodes.

    Args:
        nodes: (N, 3) nodes.
        samples_per_span: number of points from one node to the next, 1 or more.

    Returns:
        ((N - 1) * samples_per_span + 1, 3) points, among them all nodes.
    """
    parameter = np.arange(len(nodes))
    fine = np.linspace(0, len(nodes) - 1, (len(nodes) - 1) * samples_per_span + 1)
    curve: Points = CubicSpline(parameter, nodes)(fine)
    return curve


def tangents(curve: Points) -> Points:
    """Compute the unit tangents (N, 3) of a finely sampled curve (N, 3), by central differences."""
    difference = np.gradient(curve, axis=0)
    unit: Points = difference / np.linalg.norm(difference, axis=1, keepdims=True)
    return unit


def parts_near(curve: Points, half_edge_m: float) -> list[slice]:
    """Find the parts of a curve that lie within a square about the z axis.

    Args:
        curve: (N, 3) points, in metres.
        half_edge_m: half the square's edge, in metres.

    Returns:
        The slice of each part's points, with one more point on either side.
    """
    inside = (np.abs(curve[:, :2]) <= half_edge_m).all(axis=1)
    inside[1:] |= inside[:-1].copy()
    inside[:-1] |= inside[1:].copy()
    changes = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(np.int8)))
    return [slice(int(a), int(b)) for a, b in zip(changes[::2], changes[1::2], strict=True) if b - a > 1]
