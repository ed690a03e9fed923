"""Small builds of the surfaces, each made once for all tests."""

from functools import cache

import numpy as np
import numpy.typing as npt

from assets.surfaces.catalogue import SURFACES
from assets.surfaces.kit.maps import SurfaceMaps
from assets.surfaces.recipe import recipe_generator

PIXELS = 768
"""Edge of the small builds, texels: joints half a millimetre wide show, and 2, 3 or 4 tiles fit evenly."""


@cache
def built(name: str) -> SurfaceMaps:
    """The maps of a surface, 768 by 768 texels."""
    recipe = SURFACES[name]
    return recipe.build(recipe_generator(recipe), PIXELS)


def steps(image: npt.NDArray[np.generic], axis: int) -> npt.NDArray[np.float64]:
    """Mean difference between each row (axis 0) or column (axis 1) and the one before; the first is the seam's."""
    values = np.asarray(image, np.float64)
    difference = np.abs(values - np.roll(values, 1, axis))
    return np.asarray(difference.mean(axis=tuple(i for i in range(values.ndim) if i != axis)))
