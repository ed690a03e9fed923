"""The square, periodic grid of texels on which every surface is drawn."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Field: TypeAlias = npt.NDArray[np.float32]
"""A scalar per texel, shape (H, W), or a colour per texel, shape (H, W, 3) in sRGB 0 to 1."""

Labels: TypeAlias = npt.NDArray[np.int32]
"""The number of the board, tile, stone or cell that holds each texel, shape (H, W), from 0."""


@dataclass(frozen=True)
class Grid:
    """A square tile of `pixels` by `pixels` texels whose opposite edges meet.

    Attributes:
        pixels: Texels along an edge.
        size_mm: Length of an edge in millimetres.
    """

    pixels: int
    size_mm: float

    @property
    def texel_mm(self) -> float:
        """Edge of one texel in millimetres."""
        return self.size_mm / self.pixels

    def axis(self) -> Field:
        """Compute the positions of the texel centres along an edge in millimetres, shape (pixels,)."""
        return ((np.arange(self.pixels) + 0.5) * self.texel_mm).astype(np.float32)

    def coordinates(self) -> tuple[Field, Field]:
        """Compute the position of every texel centre: x to the right and y down, in millimetres, each shape (H, W)."""
        x, y = np.meshgrid(self.axis(), self.axis())
        return x, y

    def zeros(self) -> Field:
        """Make a field of zeros, shape (H, W)."""
        return np.zeros((self.pixels, self.pixels), np.float32)
