"""The scene of the fall: strips of cloth in one self-colliding mesh, a rigid floor, and the wind.

Its unit of length is chosen by the worker so that a cable's radius is a fixed number of units, because the cloth
solver's collision distances have limits of their own (1 mm to 10 cm, whatever the scene's scale).

One mesh and not one object a cable: separate cloth objects that collide with each other form dependency cycles, whose
results differ from run to run. The strips are zigzags of single triangles, narrower than the cable: two vertices
abreast would be nearer to each other than the collision distance and push themselves apart for ever.
"""

from typing import Any

import bpy

from blend import names

FLOOR_HALF_EDGE = 600.0
_FIELD_SEED = 1
"""Blender numbers the fields of a session otherwise, and builds would differ."""
SELF_DISTANCE = 0.1
"""Largest that Blender takes; the solver keeps faces twice this apart."""


def add_fall(scene: Any) -> None:
    """Fill the scene of the fall."""
    scene.gravity = (0.0, 0.0, -9.81)
    scene.frame_start, scene.frame_end = 1, 250
    add_floor(scene)
    add_cables(scene)
    add_wind(scene)


def add_floor(scene: Any) -> Any:
    """Add the rigid floor at z = 0 and return it."""
    edge = FLOOR_HALF_EDGE
    mesh = bpy.data.meshes.new(names.FALL_FLOOR)
    mesh.from_pydata([(-edge, -edge, 0), (edge, -edge, 0), (edge, edge, 0), (-edge, edge, 0)], [], [(0, 1, 2, 3)])
    floor = bpy.data.objects.new(names.FALL_FLOOR, mesh)
    scene.collection.objects.link(floor)
    floor.modifiers.new("Collision", "COLLISION")
    floor.collision.cloth_friction = 30.0
    floor.collision.damping = 0.1
    floor.field.seed = _FIELD_SEED
    return floor


def add_cables(scene: Any) -> Any:
    """Add the object of the strips, one triangle as yet, and return it."""
    mesh = bpy.data.meshes.new(names.FALL_CABLES)
    mesh.from_pydata([(0, -0.04, 1), (0.5, 0.04, 1), (1.0, -0.04, 1)], [], [(0, 1, 2)])
    cables = bpy.data.objects.new(names.FALL_CABLES, mesh)
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
    wind = bpy.data.objects.new(names.FALL_WIND, None)
    scene.collection.objects.link(wind)
    layer = scene.view_layers[0]
    with bpy.context.temp_override(scene=scene, view_layer=layer, object=wind, active_object=wind):
        bpy.ops.object.forcefield_toggle()
    wind.field.type = "WIND"
    wind.field.strength = 0.0
    wind.field.seed = _FIELD_SEED
    return wind
