"""A cable's Young's modulus and density as settings of a zigzag strip of Blender's cloth.

The shape of a cable at rest depends on its bending stiffness over its weight per length, EI / w, a length cubed; for a
round section it is E r^2 / (4 rho g). It is carried over to the fall's units; the mass itself is the published one.

Blender's angular bending springs act across the edge that two triangles share. In a strip of segments l, width w and
diagonals e = hypot(l, w), two such triangles are (0, 1, 2) and (1, 2, 3). Each pushes its three corners by a third of
the spring's force, and the shared edge back by half of it, which leaves a third on each of the four corners, signed
+ - - +. The spring's constant is 0.1 b e and the fold D e / (2 l w), with D = z0 - z1 - z2 + z3, which is 2 l^2 times
the curvature; the bending moment is 2 l times the force at a corner. So

    EI = b l^2 e^2 / (15 w),

in units of the fall and of the frame: the solver's gravity is 0.001 of the scene's. Sideways the strip bends by
stretching its two rails, which is EI = 2 s l w^2 / (e + 2 l) at a stretching setting of s, since Blender divides s by
the mean length of all springs. Both are set to what the cable asks for, so that it bends alike in all directions.

Bending springs are integrated explicitly, so a setting above `most_bending` would make the strip explode; such a cable
gets that setting and is softer than asked for, which `achieved_moduli_pa` tells.
"""

from dataclasses import dataclass

import numpy as np

from farm.scene.cable import Cable
from farm.scene.scene import Scene
from farm.spec.simulation import ClothFall
from worker.simulate.cloth.scale import GRAVITY, RADIUS_UNITS, FallScale

SEGMENT_UNITS = 5.0 * RADIUS_UNITS
"""Length of a strip's segment, in units of the fall."""

STRIP_WIDTH = 0.08
"""Width of a strip in units of the fall: less than the cable's, so that the strip turns over as a round one does."""

DIAGONAL = float(np.hypot(SEGMENT_UNITS, STRIP_WIDTH))
"""Length of the edge between two triangles of a strip, in units of the fall."""

SOLVER_GRAVITY = 0.001 * GRAVITY
"""The gravity that the solver applies, in units of the fall per frame squared."""

LEAST_STRETCHING = 20.0
"""Least setting of stretching: about what the softest drawn cable asks for; at 10 a landed cable still keeps its length
within 0.03 %."""

_STABLE_SHARE = 0.6
"""Greatest bending that is set, as a share of the one at which a straight strip becomes unstable."""

_DAMPING_SHARE = 0.2
"""Bending damping that is set, as a share of the one at which a straight strip becomes unstable."""

_FASTEST_MODE = 9.48
"""Largest value of 16 sin(q)^2 sin(q / 2)^2: the square of D for nodes moved by one unit in the worst pattern."""


@dataclass(frozen=True, slots=True)
class StripMaterial:
    """Settings of Blender's cloth.

    Attributes:
        vertex_mass: mass of every vertex.
        bending: each cable's setting of bending.
        bending_damping: the damping that all cables share.
        stretching: each cable's setting of tension and compression.
    """

    vertex_mass: float
    bending: tuple[float, ...]
    bending_damping: float
    stretching: tuple[float, ...]


def strip_material(scene: Scene, scale: FallScale, fall: ClothFall) -> StripMaterial:
    """The settings for a scene's cables."""
    return material_for([stiffness_over_weight(cable, scale) for cable in scene.cables], scene.vertex_mass, fall)


def material_for(stiffnesses: list[float], vertex_mass: float, fall: ClothFall) -> StripMaterial:
    """The settings for cables of given stiffness, as nearly as Blender allows.

    Args:
        stiffnesses: each cable's EI / w, in cubed units of the fall.
        vertex_mass: mass of every vertex.
        fall: the cloth's settings, of which the quality bounds the bending.
    """
    most = most_bending(vertex_mass, fall)
    weight = _weight(vertex_mass)
    rails = 2 * SEGMENT_UNITS * STRIP_WIDTH**2 / (DIAGONAL + 2 * SEGMENT_UNITS)
    return StripMaterial(
        vertex_mass=vertex_mass,
        bending=tuple(min(stiffness * weight / _stiffness_per_setting(), most) for stiffness in stiffnesses),
        bending_damping=_DAMPING_SHARE * 18 * vertex_mass * fall.quality / _FASTEST_MODE,
        stretching=tuple(max(stiffness * weight / rails, LEAST_STRETCHING) for stiffness in stiffnesses),
    )


def stiffness_over_weight(cable: Cable, scale: FallScale) -> float:
    """EI / w of a cable in cubed units of the fall."""
    radius = cable.diameter_m / 2
    cubic_metres = cable.youngs_modulus_pa * radius**2 / (4 * cable.density_kg_m3 * GRAVITY)
    return float(cubic_metres / scale.unit_m**3)


def most_bending(vertex_mass: float, fall: ClothFall) -> float:
    """The highest bending setting that is safe.

    A node's stiffness in the fastest pattern over its mass, times the square of a solver step of 1 / quality frames, is
    to stay below 4.
    """
    limit = 4 * vertex_mass * fall.quality**2
    per_setting = 0.1 * DIAGONAL**2 / (6 * SEGMENT_UNITS * STRIP_WIDTH) * _FASTEST_MODE
    return _STABLE_SHARE * limit / per_setting


def achieved_stiffness(bending: float, vertex_mass: float) -> float:
    """EI / w in cubed units of the fall, as a setting gives it."""
    return bending * _stiffness_per_setting() / _weight(vertex_mass)


def achieved_moduli_pa(scene: Scene, fall: ClothFall) -> tuple[float, ...]:
    """Young's modulus of each cable as the cloth has it: the one asked for, or less where that would not be stable."""
    scale = FallScale.for_radius(max(cable.diameter_m for cable in scene.cables) / 2)
    material = strip_material(scene, scale, fall)
    return tuple(
        cable.youngs_modulus_pa
        * achieved_stiffness(bending, material.vertex_mass)
        / stiffness_over_weight(cable, scale)
        for cable, bending in zip(scene.cables, material.bending, strict=True)
    )


def _stiffness_per_setting() -> float:
    return SEGMENT_UNITS**2 * DIAGONAL**2 / (15 * STRIP_WIDTH)


def _weight(vertex_mass: float) -> float:
    """Weight per length of a strip, in the solver's units."""
    return vertex_mass * SOLVER_GRAVITY / SEGMENT_UNITS
