"""The surface of a cable, unrolled, while it is drawn."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.model import Rgb
from worker.noise import Field

_DARKEST, _LIGHTEST = 0.09, 0.91
"""sRGB, of black and white plastics: they throw back about 1 % and 80 % of the light."""


@dataclass(slots=True)
class Canvas:
    """A cable's surface: rows around it, from the top of the image down, columns along it.

    Attributes:
        length_m: of the cable.
        around_m: its circumference.
        colour: (3, rows, columns) sRGB, 0 to 1: planes, which numpy works through faster than triples.
        roughness: (rows, columns) 0 to 1.
        height_m: (rows, columns) of its relief, or None if it is smooth.
        metallic: of it all.
        coat: weight of a clear layer over it.
    """

    length_m: float
    around_m: float
    colour: Field
    roughness: Field
    height_m: Field | None = None
    metallic: float = 0.0
    coat: float = 0.0

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.roughness.shape[0], self.roughness.shape[1]

    @property
    def texel_m(self) -> tuple[float, float]:
        """Around and along."""
        return self.around_m / self.shape[0], self.length_m / self.shape[1]

    @property
    def around(self) -> Field:
        """(rows, 1): where each row is around the cable, 0 to 1, as the texture coordinate counts."""
        rows = self.shape[0]
        return (1.0 - (np.arange(rows, dtype=np.float32)[:, None] + 0.5) / rows).astype(np.float32)

    @property
    def along_m(self) -> Field:
        """(1, columns): where each column is along the cable."""
        return ((np.arange(self.shape[1], dtype=np.float32)[None] + 0.5) * self.texel_m[1]).astype(np.float32)

    def cells(self, around_m: float, along_m: float) -> tuple[float, float]:
        """A size on the cable in rows and columns."""
        return around_m / self.texel_m[0], along_m / self.texel_m[1]

    def blend(self, alpha: Field, colour: NDArray[np.float32]) -> None:
        """Lay a colour (3, 1, 1) or (3, rows, columns) over the canvas where `alpha` (rows, columns) is above 0."""
        change = colour - self.colour
        change *= alpha
        self.colour += change

    def blend_roughness(self, alpha: Field, roughness: float) -> None:
        """Lay a roughness over the canvas likewise."""
        self.roughness += alpha * (np.float32(roughness) - self.roughness)


def pigment(colour: Rgb) -> NDArray[np.float32]:
    """Levels of sRGB as shares of it, (3, 1, 1), no darker and no lighter than plastics and textiles are."""
    shares = np.array(colour, np.float32).reshape(3, 1, 1) / np.float32(255)
    return (_DARKEST + (_LIGHTEST - _DARKEST) * shares).astype(np.float32)


def tone(red: float, green: float, blue: float) -> NDArray[np.float32]:
    """SRGB from 0 to 1 as (3, 1, 1)."""
    return np.array([red, green, blue], np.float32).reshape(3, 1, 1)
