"""Every surface there is, by name."""

from collections.abc import Mapping
from types import MappingProxyType

from assets.surfaces import (
    brick,
    concrete,
    fabric,
    ground,
    laminate,
    mat,
    metal,
    perforated,
    plaster,
    sheet,
    stone,
    tile,
    wood,
)
from assets.surfaces.recipe import SurfaceRecipe

SURFACES: Mapping[str, SurfaceRecipe] = MappingProxyType(
    {
        recipe.name: recipe
        for family in (
            wood,
            tile,
            brick,
            stone,
            concrete,
            plaster,
            metal,
            perforated,
            ground,
            fabric,
            sheet,
            laminate,
            mat,
        )
        for recipe in family.RECIPES
    }
)
"""Name to recipe, family by family."""
