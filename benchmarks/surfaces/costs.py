"""The cost of surfaces relative to a plain one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MOST = 1.10
"""Most CPU seconds of rendering a surface, over those of a plain one."""


@dataclass(frozen=True, slots=True)
class SurfaceCost:
    """CPU seconds of one surface and of a plain one, in the same scenes.

    Attributes:
        name: the surface.
        render_s: seconds of rendering each scene with the surface.
        plain_render_s: seconds of rendering each scene with the plain one.
        build_s: seconds of building each scene with the surface.
        plain_build_s: seconds of building each scene with the plain one.
    """

    name: str
    render_s: Sequence[float]
    plain_render_s: Sequence[float]
    build_s: Sequence[float]
    plain_build_s: Sequence[float]

    @property
    def ratio(self) -> float:
        """Time of rendering, relative to the plain surface's."""
        return float(np.sum(self.render_s) / np.sum(self.plain_render_s))

    @property
    def whole_ratio(self) -> float:
        """Building and rendering over building and rendering the plain one."""
        plain = np.sum(self.plain_render_s) + np.sum(self.plain_build_s)
        return float((np.sum(self.render_s) + np.sum(self.build_s)) / plain)


def too_costly(costs: Sequence[SurfaceCost]) -> list[SurfaceCost]:
    """The surfaces above `MOST`, the costliest first."""
    return sorted((cost for cost in costs if cost.ratio > MOST), key=lambda cost: -cost.ratio)
