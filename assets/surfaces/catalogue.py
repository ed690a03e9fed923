"""Every surface there is, by name."""

from collections.abc import Mapping
from types import MappingProxyType

from assets.surfaces import (
    brick,
    concrete,
    electronics,
    fabric,
    ground,
    keyboard,
    laminate,
    mat,
    metal,
    paper,
    perforated,
    plaster,
    sheet,
    stone,
    tile,
    wood,
)
from assets.surfaces.recipe import SurfaceRecipe

_FLOORS = (wood, tile, stone, concrete, plaster, metal, ground, fabric, sheet)
_WORKPLACE = (brick, electronics, keyboard, laminate, mat, paper, perforated)

SURFACES: Mapping[str, SurfaceRecipe] = MappingProxyType(
    {recipe.name: recipe for family in (*_FLOORS, *_WORKPLACE) for recipe in family.RECIPES}
)
"""Name to recipe, family by family."""
