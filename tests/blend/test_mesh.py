"""Arrays that become meshes."""

from typing import Any

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from blend.mesh import MeshArrays, add_mesh, starts_of  # noqa: E402  # after importorskip

pytestmark = pytest.mark.blender

POINTS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)], float)
CORNERS = np.array([0, 1, 2, 3, 0, 1, 4])
SIZES = np.array([4, 3])
PLAIN = MeshArrays(vertices_m=POINTS, corners=CORNERS, face_starts=starts_of(SIZES))


@pytest.fixture
def scene() -> Any:
    """The scene of an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene


def test_polygons_have_the_vertices_of_their_corners(scene: Any) -> None:
    """In order, however many each has; edges come by themselves."""
    mesh = add_mesh(scene, "quad and triangle", PLAIN, []).data
    assert [tuple(polygon.vertices) for polygon in mesh.polygons] == [(0, 1, 2, 3), (0, 1, 4)]
    np.testing.assert_array_equal([tuple(vertex.co) for vertex in mesh.vertices], POINTS)
    assert len(mesh.edges) == 6
    assert not mesh.validate()


def test_the_object_is_in_the_scene_under_its_name(scene: Any) -> None:
    """With its materials in their order."""
    materials = [bpy.data.materials.new(name) for name in ("b", "a")]
    made = add_mesh(scene, "quad", PLAIN, materials)
    assert scene.objects["quad"] == made
    assert [slot.name for slot in made.data.materials] == ["b", "a"]


@pytest.mark.parametrize(
    ("smooth", "seen"), [(True, [True, True]), (False, [False, False]), (np.array([False, True]), [False, True])]
)
def test_polygons_are_smooth_where_they_are_said_to_be(scene: Any, smooth: Any, seen: list[bool]) -> None:
    """By one answer for all, or one for each."""
    arrays = MeshArrays(vertices_m=POINTS, corners=CORNERS, face_starts=starts_of(SIZES), smooth=smooth)
    mesh = add_mesh(scene, "shaded", arrays, []).data
    assert [polygon.use_smooth for polygon in mesh.polygons] == seen


def test_what_materials_read_is_there(scene: Any) -> None:
    """Coordinates of each corner, attributes of each vertex, and the material of each polygon."""
    uv = np.arange(14).reshape(7, 2) / 16
    colours, vectors = np.arange(20).reshape(5, 4) / 32, -POINTS
    arrays = MeshArrays(
        vertices_m=POINTS,
        corners=CORNERS,
        face_starts=starts_of(SIZES),
        materials=np.array([1, 0]),
        uv=uv,
        uv_name="print",
        attributes={"tint": colours, "grain": vectors},
    )
    mesh = add_mesh(scene, "full", arrays, [None, None]).data
    np.testing.assert_array_equal([tuple(each.vector) for each in mesh.uv_layers["print"].uv], uv)
    np.testing.assert_array_equal([tuple(each.color) for each in mesh.attributes["tint"].data], colours)
    np.testing.assert_array_equal([tuple(each.vector) for each in mesh.attributes["grain"].data], vectors)
    assert [polygon.material_index for polygon in mesh.polygons] == [1, 0]


def test_starts_follow_from_sizes() -> None:
    """Each polygon starts where the one before ends."""
    assert starts_of(np.array([4, 3, 5])).tolist() == [0, 4, 7]
