"""The contract of a template: the objects, nodes and links that the farm relies on, and the check for them.

All of it belongs to the picture; a simulator brings what it needs itself.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import bpy

from blend import names
from blend.unsafe import find_unsafe
from farm.errors import TemplateError

_OBJECTS: Final = (
    (names.CABLE, "MESH", None),
    (names.FLOOR, "MESH", None),
    (names.CAMERA, "CAMERA", None),
    (names.POINT_LAMP, "LIGHT", "POINT"),
    (names.AREA_LAMP, "LIGHT", "AREA"),
)

_NODES: Final = (
    ("materials", names.CABLE, names.CABLE_MAPPING, "MAPPING"),
    ("materials", names.CABLE, names.CABLE_NOISE, "TEX_NOISE"),
    ("materials", names.CABLE, names.CABLE_COLOUR_RAMP, "VALTORGB"),
    ("materials", names.CABLE, names.CABLE_REFLECTION_RAMP, "VALTORGB"),
    ("materials", names.SKIN, names.SKIN_COLOUR, "TEX_IMAGE"),
    ("materials", names.SKIN, names.SKIN_ROUGHNESS, "TEX_IMAGE"),
    ("materials", names.SKIN, names.SKIN_NORMAL, "TEX_IMAGE"),
    ("materials", names.SKIN, names.SKIN_SURFACE, "BSDF_PRINCIPLED"),
    ("materials", names.FLOOR, names.FLOOR_COLOUR, "TEX_IMAGE"),
    ("materials", names.FLOOR, names.FLOOR_ROUGHNESS, "TEX_IMAGE"),
    ("materials", names.FLOOR, names.FLOOR_METALLIC, "TEX_IMAGE"),
    ("materials", names.FLOOR, names.FLOOR_NORMAL, "TEX_IMAGE"),
    ("worlds", names.WORLD, names.WORLD_SWITCH, "MIX_SHADER"),
    ("worlds", names.WORLD, names.WORLD_BRIGHTNESS, "MIX_SHADER"),
    ("worlds", names.WORLD, names.WORLD_MAPPING, "MAPPING"),
    ("worlds", names.WORLD, names.WORLD_IMAGE, "TEX_ENVIRONMENT"),
    ("worlds", names.WORLD, names.WORLD_GREY, "BACKGROUND"),
)


def open_template(path: Path) -> None:
    """Open a template in this process, with the scripts in it left off, and check it.

    Raises:
        TemplateError: if it can't be opened, lacks something, or brings code or outside files; the text names what.
    """
    if not path.is_file():
        raise TemplateError(f"{path}: no such template; give --template a .blend file")
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
    except RuntimeError as error:
        reason = " ".join(str(error).split())
        raise TemplateError(f"{path}: Blender can't open this template: {reason}") from error
    missing = list(find_missing())
    if missing:
        raise TemplateError(f"{path}: the template lacks {'; '.join(missing)}")
    unsafe = list(find_unsafe())
    if unsafe:
        raise TemplateError(f"{path}: the template must not hold {'; '.join(unsafe)}")


def find_missing() -> Iterator[str]:
    """Yield each thing that the open file lacks of the contract, as a phrase; nothing if it holds all."""
    if names.PICTURE_SCENE not in bpy.data.scenes:
        yield f"the scene '{names.PICTURE_SCENE}'"
    for object_name, kind, subkind in _OBJECTS:
        yield from _missing_object(object_name, kind, subkind)
    for collection, owner, node, kind in _NODES:
        yield from _missing_node(collection, owner, node, kind)
    yield from _missing_links()
    yield from _misplaced()
    yield from _wrong_ramps()


def _missing_object(name: str, kind: str, subkind: str | None) -> Iterator[str]:
    scene = bpy.data.scenes.get(names.PICTURE_SCENE)
    found = scene.objects.get(name) if scene else None
    wanted = f"{kind.lower()} object '{name}' in the scene '{names.PICTURE_SCENE}'"
    if found is None or found.type != kind:
        yield f"the {wanted}"
    elif subkind and found.data.type != subkind:
        yield f"a {subkind.lower()} light in the {wanted}"


def _missing_node(collection: str, owner_name: str, node: str, kind: str) -> Iterator[str]:
    owner: Any = getattr(bpy.data, collection).get(owner_name)
    place = f"the {collection.removesuffix('s')} '{owner_name}'"
    if owner is None or owner.node_tree is None:
        yield f"{place} with nodes (for its node '{node}')"
        return
    found = owner.node_tree.nodes.get(node)
    if found is None or found.type != kind:
        yield f"the node '{node}' of type {kind} in {place}"


def _missing_links() -> Iterator[str]:
    """Yield each missing link that the worker's settings need: to the camera, the world, a material or a UV map."""
    picture = bpy.data.scenes.get(names.PICTURE_SCENE)
    if picture is None:
        return
    if picture.camera is None or picture.camera.name != names.CAMERA:
        yield f"'{names.CAMERA}' as the active camera of the scene '{names.PICTURE_SCENE}'"
    if picture.world is None or picture.world.name != names.WORLD:
        yield f"'{names.WORLD}' as the world of the scene '{names.PICTURE_SCENE}'"
    for name in (names.CABLE, names.FLOOR):
        found = picture.objects.get(name)
        if found is None or found.type != "MESH":
            continue
        if [slot.name for slot in found.material_slots] != [name]:
            yield f"the material '{name}' as the only material of the object '{name}'"
        if not found.data.uv_layers:
            yield f"a UV map on the object '{name}'"


def _misplaced() -> Iterator[str]:
    """Yield each placement of floor and camera that the masks and the fall rely on and that the file lacks."""
    floor = bpy.data.objects.get(names.FLOOR)
    if floor is not None and not _is_unmoved(floor):
        yield f"'{names.FLOOR}' unmoved, unturned and unscaled at the origin, with no parent or constraint"
    elif floor is not None and floor.type == "MESH" and any(vertex.co.z != 0.0 for vertex in floor.data.vertices):
        yield f"'{names.FLOOR}' flat at z = 0"
    camera = bpy.data.objects.get(names.CAMERA)
    if camera is not None and (camera.parent is not None or len(camera.constraints)):
        yield f"'{names.CAMERA}' without parent and constraints"


def _is_unmoved(floor: Any) -> bool:
    free = floor.parent is None and not len(floor.constraints)
    placed = (*floor.location, *floor.rotation_euler, *(scale - 1.0 for scale in floor.scale))
    return free and not any(placed)


def _wrong_ramps() -> Iterator[str]:
    material = bpy.data.materials.get(names.CABLE)
    if material is None or material.node_tree is None:
        return
    for name in (names.CABLE_COLOUR_RAMP, names.CABLE_REFLECTION_RAMP):
        ramp = material.node_tree.nodes.get(name)
        if ramp is not None and ramp.type == "VALTORGB" and len(ramp.color_ramp.elements) != 2:
            yield f"exactly two stops in the ramp '{name}'"
