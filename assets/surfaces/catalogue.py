"""Every surface there is, by name."""

from collections.abc import Mapping
from types import MappingProxyType

from assets.surfaces.families import (
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

FLOORS: Mapping[str, SurfaceRecipe] = MappingProxyType(
    {recipe.name: recipe for family in _FLOORS for recipe in family.RECIPES}
)
"""Floors as the published set-up has them: wood, tiles, stone, concrete, plaster, metal, ground, fabric and sheets."""

WORKPLACE: Mapping[str, SurfaceRecipe] = MappingProxyType(
    {
        recipe.name: recipe
        for recipes in (wood.WORKPLACE_RECIPES, *(family.RECIPES for family in _WORKPLACE))
        for recipe in recipes
    }
)
"""What cables lie on where they are worked with: bench tops, mats, paper, boards, gratings."""

SURFACES: Mapping[str, SurfaceRecipe] = MappingProxyType({**FLOORS, **WORKPLACE})
"""Name to recipe, family by family."""

LIGHT: frozenset[str] = frozenset(
    {
        *("laminate_white", "laminate_grey", "melamine_board", "whiteboard", "pegboard_white"),
        *("squared_paper", "paper_sheets", "wiring_plan", "maple_bench", "beech_bench"),
        *("ceramic_white", "marble_white", "plaster_white", "terrazzo_light", "birch_veneer"),
    }
)
"""Those that are as bright as tables and benches: their mean level is 165 at least, of 255."""
