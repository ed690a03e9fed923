"""The content of a .blend file, as plain values: two builds of the template agree in this, though not in bytes."""

from collections.abc import Mapping
from typing import Any

import bpy

_COLLECTIONS = ("scenes", "objects", "meshes", "materials", "worlds", "lights", "cameras", "images")
_PLAIN = (str, int, float, bool)
_MAX_DEPTH = 5


def describe_content() -> Mapping[str, object]:
    """Describe the open file by collection and name: every stored property that is a number, a text or a reference."""
    return {name: {block.name: _describe(block, 0) for block in getattr(bpy.data, name)} for name in _COLLECTIONS}


def _describe(owner: Any, depth: int) -> object:
    described: dict[str, object] = {}
    for definition in owner.bl_rna.properties:
        key = definition.identifier
        # Session identities and the layout of the editors differ between builds and mean nothing to a render.
        if key in _IGNORED or definition.is_hidden:
            continue
        value = _value(definition, getattr(owner, key), depth)
        if value is not None:
            described[key] = value
    return described


_IGNORED = frozenset({"rna_type", "session_uid", "original", "users", "id_data", "ui_units_x", "depsgraph", "runtime"})


def _value(definition: Any, value: Any, depth: int) -> object:
    if value is None:
        return None
    if definition.type == "POINTER":
        return _reference(value, depth)
    if definition.type == "COLLECTION":
        return [_reference(item, depth) for item in value] if depth < _MAX_DEPTH else None
    if isinstance(value, _PLAIN):
        return value
    if isinstance(value, set):
        return sorted(value)
    return _numbers(value)


def _reference(value: Any, depth: int) -> object:
    """Describe another data block by its name, and a part of this one by its content."""
    if isinstance(value, bpy.types.ID) and not isinstance(value, bpy.types.NodeTree):
        return value.name
    return _describe(value, depth + 1) if depth < _MAX_DEPTH else None


def _numbers(value: Any) -> object:
    if isinstance(value, _PLAIN):
        return value
    return [_numbers(item) for item in value]
