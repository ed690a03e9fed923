"""The canvas on which the surface of a cable is painted: the surface, unrolled."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.model import Rgb
from worker.noise import Field

_DARKEST, _LIGHTEST = 0.09, 0.91
"""sRGB values, 0 to 1, of black and white plastics, which reflect about 1 % and 80 % of the light."""


@dataclass(slots=True)
class Canvas:
    """A cable's surface: rows around it, from the top of the image down, and columns along it.

    Attributes:
        length_m: length of the cable, in metres.
        around_m: circumference of the cable, in metres.
        colour: (3, rows, columns) sRGB, 0 to 1, in planes, which numpy works through faster than triples.
        roughness: (rows, columns), 0 to 1.
        height_m: (rows, columns), height of the relief, in metres; None if the surface is smooth.
        metallic: metalness of the whole surface, 0 to 1.
        coat: weight of a clear layer over the whole surface, 0 to 1.
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
        """Number of rows and of columns."""
        return self.roughness.shape[0], self.roughness.shape[1]

    @property
    def texel_m(self) -> tuple[float, float]:
        """Size of a texel around the cable and along it, in metres."""
        return self.around_m / self.shape[0], self.length_m / self.shape[1]

    @property
    def around(self) -> Field:
        """Texture coordinate around the cable of each row, (rows, 1), 0 to 1."""
        rows = self.shape[0]
        return (1.0 - (np.arange(rows, dtype=np.float32)[:, None] + 0.5) / rows).astype(np.float32)

    @property
    def along_m(self) -> Field:
        """Place along the cable of each column, (1, columns), in metres."""
        return ((np.arange(self.shape[1], dtype=np.float32)[None] + 0.5) * self.texel_m[1]).astype(np.float32)

    def cells(self, around_m: float, along_m: float) -> tuple[float, float]:
        """Convert a size on the cable, in metres, to rows and columns."""
        return around_m / self.texel_m[0], along_m / self.texel_m[1]

    def blend(self, alpha: Field, colour: NDArray[np.float32]) -> None:
        """Blend a colour (3, 1, 1) or (3, rows, columns), sRGB, with the canvas by `alpha` (rows, columns), 0 to 1."""
        change = colour - self.colour
        change *= alpha
        self.colour += change

    def blend_roughness(self, alpha: Field, roughness: float) -> None:
        """Blend a roughness, 0 to 1, with the canvas by `alpha` (rows, columns), 0 to 1."""
        self.roughness += alpha * (np.float32(roughness) - self.roughness)


def pigment(colour: Rgb) -> NDArray[np.float32]:
    """Convert sRGB levels to (3, 1, 1), 0 to 1, no darker and no lighter than plastics and textiles are."""
    shares = np.array(colour, np.float32).reshape(3, 1, 1) / np.float32(255)
    return (_DARKEST + (_LIGHTEST - _DARKEST) * shares).astype(np.float32)


def tone(red: float, green: float, blue: float) -> NDArray[np.float32]:
    """Make a colour (3, 1, 1) from three sRGB values, 0 to 1."""
    return np.array([red, green, blue], np.float32).reshape(3, 1, 1)
