"""Every surface there is, by name.

A surface is a recipe in the tuple `RECIPES` of a module of `assets.surfaces.families`, and a family is a module there:
both are found without a list.
"""

import pkgutil
from collections.abc import Iterator, Mapping
from importlib import import_module
from types import MappingProxyType, ModuleType

from assets.surfaces import families
from assets.surfaces.recipe import SurfaceRecipe

_FIRST_FAMILIES = (
    *("wood", "tile", "stone", "concrete", "plaster", "metal", "ground", "fabric", "sheet"),
    *("brick", "electronics", "keyboard", "laminate", "mat", "paper", "perforated"),
)
"""The families that come first, in this order, which every dataset that was made with them depends on: its draws count
the surfaces in the catalogue's order. Other families follow by name, so that a new one need not be listed."""


def collect(package: ModuleType) -> Mapping[str, SurfaceRecipe]:
    """Find all surfaces of a package of families.

    Args:
        package: a package whose modules each have a tuple `RECIPES`.

    Returns:
        Name to recipe: those that the published set-up has, then the others, each family by family.

    Raises:
        ValueError: two recipes have one name.
    """
    recipes = sorted(_recipes(package), key=lambda recipe: not recipe.published)
    found: dict[str, SurfaceRecipe] = {}
    for recipe in recipes:
        if recipe.name in found:
            raise ValueError(f"two surfaces are called '{recipe.name}'; rename one of them")
        found[recipe.name] = recipe
    return MappingProxyType(found)


def _recipes(package: ModuleType) -> Iterator[SurfaceRecipe]:
    names = [module.name for module in pkgutil.iter_modules(package.__path__)]
    first = [name for name in _FIRST_FAMILIES if name in names]
    for name in (*first, *sorted(set(names) - set(first))):
        yield from import_module(f"{package.__name__}.{name}").RECIPES


SURFACES: Mapping[str, SurfaceRecipe] = collect(families)
"""Name to recipe."""
