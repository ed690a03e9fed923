"""A mesh given as numpy arrays, made an object of a Blender scene."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.floating[Any]]
Indices = NDArray[np.integer[Any]]


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshArrays:
    """The arrays of a mesh of V vertices and F polygons, which have L corners in all.

    Attributes:
        vertices_m: (V, 3) places of the vertices, in metres.
        corners: (L,) vertex of each corner, polygon after polygon.
        face_starts: (F,) first corner of each polygon, rising; it ends where the next one starts.
        smooth: whether polygons are shaded as parts of something round: one answer for all, or (F,).
        materials: (F,) place of each polygon's material among those of the object; None for the first.
        uv: (L, 2) texture coordinates of each corner; None for none.
        uv_name: name of their map.
        attributes: values of each vertex, by the name under which materials read them: (V, 3) vectors, or (V, 4) linear
            colours.
    """

    vertices_m: Numbers
    corners: Indices
    face_starts: Indices
    smooth: bool | NDArray[np.bool_] = True
    materials: Indices | None = None
    uv: Numbers | None = None
    uv_name: str = "uv"
    attributes: Mapping[str, Numbers] = field(default_factory=dict)


def add_mesh(scene: Any, name: str, arrays: MeshArrays, materials: Sequence[Any]) -> Any:
    """Make a mesh and an object of it, both of the same name, and link the object to a scene.

    Args:
        scene: scene that takes the object.
        name: name of mesh and object.
        arrays: geometry of the mesh.
        materials: materials of the object.

    Returns:
        The object.
    """
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(arrays.vertices_m))
    mesh.vertices.foreach_set("co", _floats(arrays.vertices_m))
    mesh.loops.add(len(arrays.corners))
    mesh.loops.foreach_set("vertex_index", arrays.corners.astype(np.int32, copy=False))
    mesh.polygons.add(len(arrays.face_starts))
    mesh.polygons.foreach_set("loop_start", arrays.face_starts.astype(np.int32, copy=False))
    if arrays.materials is not None:
        mesh.polygons.foreach_set("material_index", arrays.materials.astype(np.int32, copy=False))
    if not np.all(arrays.smooth):  # a new mesh is smooth
        mesh.polygons.foreach_set("use_smooth", np.broadcast_to(arrays.smooth, len(arrays.face_starts)).copy())
    for attribute, values in arrays.attributes.items():
        kind, member = ("FLOAT_COLOR", "color") if values.shape[1] == 4 else ("FLOAT_VECTOR", "vector")
        mesh.attributes.new(attribute, kind, "POINT").data.foreach_set(member, _floats(values))
    if arrays.uv is not None:
        mesh.uv_layers.new(name=arrays.uv_name).uv.foreach_set("vector", _floats(arrays.uv))
    for material in materials:
        mesh.materials.append(material)
    mesh.update(calc_edges=True)
    made = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(made)
    return made


def starts_of(sizes: Indices) -> NDArray[np.int64]:
    """Compute the first corner of each polygon, (F,), from the number of corners that each has, (F,)."""
    starts: NDArray[np.int64] = np.cumsum(sizes) - sizes
    return starts


def _floats(values: Numbers) -> NDArray[np.float32]:
    return values.astype(np.float32, copy=False).ravel()
