"""The scene of a fall of cloth: strips of cloth in one self-colliding mesh, a rigid floor, and the wind.

`worker.simulate.cloth` builds it for each fall in a scene of its own. The template that comes with the farm holds one,
too, which nothing reads: the template's SHA-256 is part of every dataset, so that its file stays as it is.

The worker chooses the scene's unit of length so that a cable's radius is a fixed number of units, because the cloth
solver's collision distances have limits of their own (1 mm to 10 cm, whatever the scene's scale).

One mesh and not one object a cable: separate cloth objects that collide with each other form dependency cycles, whose
results differ from run to run. The strips are zigzags of single triangles, narrower than the cable: two vertices
abreast would be nearer to each other than the collision distance and push themselves apart for ever.
"""

from dataclasses import dataclass
from typing import Any

import bpy

from farm.scene.physics import GRAVITY_M_S2

SCENE = "fall"
"""Name of the scene in the template that comes with the farm."""

_FLOOR, _CABLES, _WIND = "fall_floor", "fall_cables", "fall_wind"
"""Names of the objects; Blender numbers them where another has the name."""

FLOOR_HALF_EDGE = 600.0
"""Half of the floor's edge, in units: no cable rolls off it."""

SELF_DISTANCE = 0.1
"""Distance of self-collision in units, the largest that Blender takes; the solver keeps faces twice this apart."""

_FIELD_SEED = 1
"""Seed of both force fields. Blender's own choice counts the fields of a session, and builds would differ."""


@dataclass(frozen=True, slots=True)
class FallObjects:
    """Blender's objects in the scene of a fall.

    Attributes:
        floor: the rigid floor, with a Collision modifier.
        cables: the strips, with a Cloth modifier.
        wind: the force field.
    """

    floor: Any
    cables: Any
    wind: Any


def add_fall(scene: Any) -> FallObjects:
    """Fill an empty scene with the objects of a fall; gravity is that of the earth, in units."""
    scene.gravity = (0.0, 0.0, -GRAVITY_M_S2)
    scene.frame_start, scene.frame_end = 1, 250
    return FallObjects(floor=add_floor(scene), cables=add_cables(scene), wind=add_wind(scene))


def add_floor(scene: Any) -> Any:
    """Add the rigid floor at z = 0 and return it."""
    edge = FLOOR_HALF_EDGE
    mesh = bpy.data.meshes.new(_FLOOR)
    mesh.from_pydata([(-edge, -edge, 0), (edge, -edge, 0), (edge, edge, 0), (-edge, edge, 0)], [], [(0, 1, 2, 3)])
    floor = bpy.data.objects.new(_FLOOR, mesh)
    scene.collection.objects.link(floor)
    floor.modifiers.new("Collision", "COLLISION")
    floor.collision.cloth_friction = 30.0
    floor.collision.damping = 0.1
    floor.field.seed = _FIELD_SEED
    return floor


def add_cables(scene: Any) -> Any:
    """Add the object of the strips, one triangle as yet, and return it."""
    mesh = bpy.data.meshes.new(_CABLES)
    mesh.from_pydata([(0, -0.04, 1), (0.5, 0.04, 1), (1.0, -0.04, 1)], [], [(0, 1, 2)])
    cables = bpy.data.objects.new(_CABLES, mesh)
    scene.collection.objects.link(cables)
    cloth = cables.modifiers.new("Cloth", "CLOTH")
    settings, collision = cloth.settings, cloth.collision_settings
    settings.quality = 10
    settings.mass = 0.4
    settings.air_damping = 3.0
    settings.tension_stiffness = settings.compression_stiffness = settings.shear_stiffness = 200.0
    settings.tension_damping = settings.compression_damping = settings.shear_damping = 5.0
    settings.bending_model = "ANGULAR"
    settings.bending_stiffness = 20.0
    settings.bending_damping = 5.0
    collision.collision_quality = 4
    collision.distance_min = 0.015
    collision.friction = 30.0
    collision.use_self_collision = True
    collision.self_distance_min = SELF_DISTANCE
    collision.self_friction = 30.0
    return cables


def add_wind(scene: Any) -> Any:
    """Add the wind, still, and return it."""
    wind = bpy.data.objects.new(_WIND, None)
    scene.collection.objects.link(wind)
    layer = scene.view_layers[0]
    with bpy.context.temp_override(scene=scene, view_layer=layer, object=wind, active_object=wind):
        bpy.ops.object.forcefield_toggle()
    wind.field.type = "WIND"
    wind.field.strength = 0.0
    wind.field.seed = _FIELD_SEED
    return wind
