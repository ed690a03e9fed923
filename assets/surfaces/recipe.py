"""The recipe of a surface: its name, its material, its size, and the function that draws it."""

import zlib
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.maps import SurfaceMaps


class SurfaceFamily(StrEnum):
    """The material that a surface is made of."""

    WOOD = "wood"
    TILE = "tile"
    STONE = "stone"
    CONCRETE = "concrete"
    PLASTER = "plaster"
    METAL = "metal"
    GROUND = "ground"
    FABRIC = "fabric"
    SHEET = "sheet"
    PAPER = "paper"
    PLASTIC = "plastic"
    ELECTRONICS = "electronics"


@dataclass(frozen=True)
class SurfaceRecipe:
    """A surface that can be drawn at any resolution.

    Attributes:
        name: The surface's name: unique, in snake case.
        family: Material of the surface.
        size_m: Edge of the square tile in metres.
        draw: The function that draws the maps on a grid.
        version: Version of the drawing, raised whenever it changes, so that stored maps are drawn again.
        published: Whether the published set-up has it; the style `published` shows no others. No new surface has it.
        light: Whether it is as bright as tables and benches, with a mean level of 165 of 255 at least.
    """

    name: str
    family: SurfaceFamily
    size_m: float
    draw: Callable[[np.random.Generator, Grid], SurfaceMaps]
    version: int = 1
    published: bool = False
    light: bool = False

    def build(self, rng: np.random.Generator, pixels: int) -> SurfaceMaps:
        """Draw the surface.

        Args:
            rng: Source of all its randomness.
            pixels: Texels along an edge, at least 64.

        Returns:
            The maps; the same generator state and size give the same bytes.
        """
        return self.draw(rng, Grid(pixels=pixels, size_mm=self.size_m * 1000.0))


def recipe_generator(recipe: SurfaceRecipe) -> np.random.Generator:
    """Make the random generator that a recipe is baked with: it follows from the name and version alone."""
    return np.random.default_rng([zlib.crc32(recipe.name.encode()), recipe.version])
