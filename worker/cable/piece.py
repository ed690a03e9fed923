"""What a picture's cables are put together from: round tubes and small convex solids. Pure numpy."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from farm.model import Rgb
from farm.scene.cable import CableMaterial, Skin
from worker.curves import Points

OCCLUDER: Final = 0
"""The instance of what hides cables and is none itself: background in every label."""


class Substance(StrEnum):
    """What is of one colour throughout."""

    COPPER = "copper"
    TIN = "tin"
    PLASTIC = "plastic"


@dataclass(frozen=True, slots=True)
class Plain:
    """A surface of one colour, in sRGB levels; metals have that of their substance."""

    substance: Substance
    colour: Rgb


Surface = CableMaterial | Skin | Plain


@dataclass(frozen=True, slots=True)
class Tubular:
    """A round tube along a curve.

    Attributes:
        instance: 1 + the number of the cable or strand that it is a part of, or `OCCLUDER`.
        curve: (N, 3) metres, finely sampled, nowhere vertical.
        radius_m: of the tube, or (N,) at each point.
        start_m: how far along its cable the curve starts.
        end_m: and ends.
        whole_m: length of the cable.
        surface: what is seen of it.
    """

    instance: int
    curve: Points
    radius_m: float | NDArray[np.float64]
    start_m: float
    end_m: float
    whole_m: float
    surface: Surface

    @property
    def top_m(self) -> float:
        """Height that nothing of it is above."""
        return float((self.curve[:, 2] + self.radius_m).max())


@dataclass(frozen=True, slots=True)
class Convex:
    """A small solid between rings of points, convex but for what does not show.

    Attributes:
        instance: as of a tube.
        rings: (rings, points of each, 3) metres, clockwise as seen by who looks back from the last to the first.
        place_m: (3,) by whose distance it lies before or behind what it meets; of one around cables its corners tell.
        surface: what is seen of it.
        around: whether it goes around cables, which come out of its ends and hide those.
    """

    instance: int
    rings: NDArray[np.float64]
    place_m: NDArray[np.float64]
    surface: Plain
    around: bool = False

    @property
    def top_m(self) -> float:
        """Height that nothing of it is above."""
        return float(self.rings[:, :, 2].max())


Piece = Tubular | Convex
