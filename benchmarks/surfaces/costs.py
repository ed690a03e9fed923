"""The cost of surfaces relative to a plain one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MOST = 1.10
"""Largest CPU time that rendering a surface may take, relative to a plain one."""


@dataclass(frozen=True, slots=True)
class SurfaceCost:
    """CPU seconds of one surface and of a plain one, in the same scenes.

    Attributes:
        name: name of the surface.
        render_s: time to render each scene with the surface.
        plain_render_s: time to render each scene with the plain one.
        realize_s: time to build each scene with the surface.
        plain_realize_s: time to build each scene with the plain one.
    """

    name: str
    render_s: Sequence[float]
    plain_render_s: Sequence[float]
    realize_s: Sequence[float]
    plain_realize_s: Sequence[float]

    @property
    def ratio(self) -> float:
        """Time of rendering, relative to the plain surface's."""
        return float(np.sum(self.render_s) / np.sum(self.plain_render_s))

    @property
    def whole_ratio(self) -> float:
        """Time of building and rendering, relative to the plain surface's."""
        plain = np.sum(self.plain_render_s) + np.sum(self.plain_realize_s)
        return float((np.sum(self.render_s) + np.sum(self.realize_s)) / plain)


def too_costly(costs: Sequence[SurfaceCost]) -> list[SurfaceCost]:
    """The surfaces above `MOST`, the costliest first."""
    return sorted((cost for cost in costs if cost.ratio > MOST), key=lambda cost: -cost.ratio)
