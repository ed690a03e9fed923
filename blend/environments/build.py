"""Build the scene of an environment from its recipe."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from assets.environments import EnvironmentKind, EnvironmentRecipe, environment_generator
from blend.environments import factory, laboratory, office, storeroom, switch_room, workshop, yard
from blend.environments.assembly import Assembly
from blend.environments.scene import Light, stage

BUILDERS: dict[EnvironmentKind, Callable[[Assembly, np.random.Generator, int], Light]] = {
    EnvironmentKind.WORKSHOP: workshop.build,
    EnvironmentKind.LABORATORY: laboratory.build,
    EnvironmentKind.STOREROOM: storeroom.build,
    EnvironmentKind.OFFICE: office.build,
    EnvironmentKind.FACTORY: factory.build,
    EnvironmentKind.SWITCH_ROOM: switch_room.build,
    EnvironmentKind.YARD: yard.build,
}


@dataclass(frozen=True, slots=True)
class Built:
    """An environment's scene.

    Attributes:
        scene: Blender's scene, complete but for the render settings.
        assembly: the solids in it.
        light: the sky, the sun and the other light that doesn't come from lamps.
    """

    scene: Any
    assembly: Assembly
    light: Light


def build_environment(recipe: EnvironmentRecipe) -> Built:
    """Replace the open file by an empty one and build an environment in it."""
    assembly, light = assemble(recipe)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return Built(stage(assembly, light, assembly.rng), assembly, light)


def assemble(recipe: EnvironmentRecipe) -> tuple[Assembly, Light]:
    """Collect an environment's solids and its light; Blender's open file doesn't change."""
    rng = environment_generator(recipe)
    assembly = Assembly(rng)
    return assembly, BUILDERS[recipe.kind](assembly, rng, recipe.seed)
