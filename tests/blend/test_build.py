"""The template: repeatable in content, and checked."""

from pathlib import Path

import pytest

bpy = pytest.importorskip("bpy")

from blend import fall, names  # noqa: E402  # after importorskip
from blend.build import TEMPLATE, build_template  # noqa: E402
from blend.content import describe_content  # noqa: E402
from blend.contract import find_missing, open_template  # noqa: E402
from farm.errors import TemplateError  # noqa: E402

pytestmark = pytest.mark.blender


def content_of(path: Path) -> object:
    """A description of everything in a file."""
    open_template(path)
    return describe_content()


def test_a_fresh_build_equals_the_shipped_template_in_content(tmp_path: Path) -> None:
    """Building again gives the same scenes, settings and names, although bytes of the file differ."""
    build_template(tmp_path / "again.blend")
    assert content_of(tmp_path / "again.blend") == content_of(TEMPLATE)


def test_the_description_sees_a_changed_setting(tmp_path: Path) -> None:
    """One changed number shows in the comparison."""
    before = content_of(TEMPLATE)
    bpy.data.objects[names.POINT_LAMP].data.energy += 1.0
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "changed.blend"), copy=True)
    assert content_of(tmp_path / "changed.blend") != before


def test_the_shipped_template_lacks_nothing() -> None:
    """The template that comes with the farm fulfils the contract."""
    open_template(TEMPLATE)
    assert list(find_missing()) == []


@pytest.mark.parametrize(
    "name",
    [names.CABLE, names.FLOOR, names.CAMERA, names.POINT_LAMP, names.AREA_LAMP],
)
def test_a_template_without_an_object_is_refused_by_its_name(tmp_path: Path, name: str) -> None:
    """The error names what is missing."""
    open_template(TEMPLATE)
    bpy.data.objects.remove(bpy.data.objects[name])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "less.blend"), copy=True)
    with pytest.raises(TemplateError, match=f"'{name}'"):
        open_template(tmp_path / "less.blend")


@pytest.mark.parametrize(
    ("material", "node"),
    [
        (names.CABLE, names.CABLE_COLOUR_RAMP),
        (names.CABLE, names.CABLE_NOISE),
        (names.SKIN, names.SKIN_COLOUR),
        (names.SKIN, names.SKIN_SURFACE),
    ],
)
def test_a_material_without_a_node_is_refused(tmp_path: Path, material: str, node: str) -> None:
    """A material that lacks one of the contract's nodes is refused."""
    open_template(TEMPLATE)
    nodes = bpy.data.materials[material].node_tree.nodes
    nodes.remove(nodes[node])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "less.blend"), copy=True)
    with pytest.raises(TemplateError, match=node):
        open_template(tmp_path / "less.blend")


def test_a_floor_that_was_moved_is_refused(tmp_path: Path) -> None:
    """A floor that isn't at z = 0 is refused, as masks and falls rely on it."""
    open_template(TEMPLATE)
    bpy.data.objects[names.FLOOR].location.z = 0.01
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "moved.blend"), copy=True)
    with pytest.raises(TemplateError, match="'floor' unmoved"):
        open_template(tmp_path / "moved.blend")


def test_a_dirt_ramp_of_three_stops_is_refused(tmp_path: Path) -> None:
    """A dirt ramp must have two stops, as the worker sets a clean and a dirty one."""
    open_template(TEMPLATE)
    ramp = bpy.data.materials[names.CABLE].node_tree.nodes[names.CABLE_COLOUR_RAMP].color_ramp
    ramp.elements.new(0.5)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "three.blend"), copy=True)
    with pytest.raises(TemplateError, match="two stops in the ramp 'dirt ramp'"):
        open_template(tmp_path / "three.blend")


def test_a_file_that_is_no_blend_is_refused(tmp_path: Path) -> None:
    """The error names the file."""
    wrong = tmp_path / "wrong.blend"
    wrong.write_text("not a blend file")
    with pytest.raises(TemplateError, match=r"wrong\.blend"):
        open_template(wrong)


def test_a_template_that_is_not_there_is_refused(tmp_path: Path) -> None:
    """The error names the file."""
    with pytest.raises(TemplateError, match=r"nowhere\.blend"):
        open_template(tmp_path / "nowhere.blend")


def test_a_template_without_a_scene_of_the_fall_is_accepted(tmp_path: Path) -> None:
    """Simulators bring what they need."""
    open_template(TEMPLATE)
    bpy.data.batch_remove([*bpy.data.scenes[fall.SCENE].objects, bpy.data.scenes[fall.SCENE]])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "picture.blend"), copy=True)
    open_template(tmp_path / "picture.blend")
    assert [scene.name for scene in bpy.data.scenes] == [names.PICTURE_SCENE]


def test_scripts_in_a_template_do_not_run(tmp_path: Path) -> None:
    """A text block that is registered to run at load doesn't run."""
    open_template(TEMPLATE)
    marker = tmp_path / "ran"
    text = bpy.data.texts.new("attack.py")
    text.write(f"open({str(marker)!r}, 'w').close()")
    text.use_module = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "attack.blend"), copy=True)
    with pytest.raises(TemplateError, match="attack"):
        open_template(tmp_path / "attack.blend")
    assert not marker.exists()
