"""The pieces of which a picture's cables consist: round tubes and small convex solids. Pure numpy."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from farm.model import Rgb
from farm.scene.cable import CableMaterial, Skin
from worker.curves import Points

OCCLUDER: Final = 0
"""Instance number of pieces that hide cables and belong to none, which are background in every label."""


class Substance(StrEnum):
    """The material of a piece that has one colour throughout."""

    COPPER = "copper"
    TIN = "tin"
    PLASTIC = "plastic"


@dataclass(frozen=True, slots=True)
class Plain:
    """A surface of one colour.

    Attributes:
        substance: material, which decides the gloss.
        colour: sRGB levels.
    """

    substance: Substance
    colour: Rgb


Surface = CableMaterial | Skin | Plain


@dataclass(frozen=True, slots=True)
class Tubular:
    """A round tube along a curve.

    Attributes:
        instance: instance number of the cable or strand to which it belongs, from 1, or `OCCLUDER`.
        curve: (N, 3) metres, centreline of the tube, finely sampled; that of a cable is nowhere vertical.
        radius_m: radius of the tube, or (N,), radius at each point, in metres.
        start_m: place along the cable at which the curve starts, in metres.
        end_m: place along the cable at which the curve ends, in metres.
        whole_m: length of the cable, in metres.
        surface: surface of the tube.
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
        """Height of its highest point, in metres."""
        return float((self.curve[:, 2] + self.radius_m).max())


@dataclass(frozen=True, slots=True)
class Convex:
    """A small solid between rings of points, convex but for details that do not show.

    Attributes:
        instance: instance number of the cable or strand to which it belongs, from 1, or `OCCLUDER`.
        rings: (rings, points of a ring, 3) metres; seen from the last ring towards the first, points run clockwise.
        place_m: (3,) metres, point whose distance from the camera decides what it hides; one with `around` uses its
            corners.
        surface: surface of the solid.
        around: whether it goes around cables, which come out of its ends and hide them.
    """

    instance: int
    rings: NDArray[np.float64]
    place_m: NDArray[np.float64]
    surface: Plain
    around: bool = False

    @property
    def top_m(self) -> float:
        """Height of its highest point, in metres."""
        return float(self.rings[:, :, 2].max())


Piece = Tubular | Convex
