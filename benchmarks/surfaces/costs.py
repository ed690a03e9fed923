"""The cost of surfaces over a plain one, as figures."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MOST = 1.10
"""A surface may cost so many times what a plain one does at render time."""


@dataclass(frozen=True, slots=True)
class SurfaceCost:
    """CPU seconds of one surface and of a plain one, in the same scenes.

    Attributes:
        render_s: of rendering, for each scene; the same for `plain_render_s`.
        realize_s: of setting the scene.
    """

    name: str
    render_s: Sequence[float]
    plain_render_s: Sequence[float]
    realize_s: Sequence[float]
    plain_realize_s: Sequence[float]

    @property
    def ratio(self) -> float:
        """Rendering over rendering the plain one."""
        return float(np.sum(self.render_s) / np.sum(self.plain_render_s))

    @property
    def whole_ratio(self) -> float:
        """Setting the scene and rendering, likewise."""
        plain = np.sum(self.plain_render_s) + np.sum(self.plain_realize_s)
        return float((np.sum(self.render_s) + np.sum(self.realize_s)) / plain)


def too_costly(costs: Sequence[SurfaceCost]) -> list[SurfaceCost]:
    """Those above `MOST`, the costliest first."""
    return sorted((cost for cost in costs if cost.ratio > MOST), key=lambda cost: -cost.ratio)
