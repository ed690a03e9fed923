"""Every surface there is, by name."""

from collections.abc import Mapping
from types import MappingProxyType

from assets.surfaces import concrete, fabric, ground, metal, plaster, sheet, stone, tile, wood
from assets.surfaces.recipe import SurfaceRecipe

SURFACES: Mapping[str, SurfaceRecipe] = MappingProxyType(
    {
        recipe.name: recipe
        for family in (wood, tile, stone, concrete, plaster, metal, ground, fabric, sheet)
        for recipe in family.RECIPES
    }
)
"""Name to recipe, family by family."""
