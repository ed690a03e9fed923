"""Makes hostile templates, as a program of its own: KIND TARGET MARKER.

Or renders one, with its scripts or without: `trusting` or `careful`, FILE PICTURE.

Blender runs what a file brings only where it is told to; each kind tries one way, and would write the marker file.
"""

import sys
from pathlib import Path
from typing import Any

import bpy

from blend import names
from blend.build import TEMPLATE
from worker.service.exit import end_process


def _touch(marker: str) -> str:
    return f"open({marker!r}, 'w').close()"


def _text(marker: str) -> None:
    text = bpy.data.texts.new("start.py")
    text.write(_touch(marker))
    text.use_module = True


def _handler(marker: str) -> None:
    text = bpy.data.texts.new("handler.py")
    text.write(f"import bpy\ndef touch(*_):\n    {_touch(marker)}\n")
    text.write("bpy.app.handlers.load_post.append(touch)\nbpy.app.handlers.render_pre.append(touch)\n")
    text.write("bpy.app.handlers.depsgraph_update_post.append(touch)\n")
    text.use_module = True


def _driver(marker: str) -> None:
    item = bpy.data.objects.new("driven", None)
    bpy.data.scenes[names.PICTURE_SCENE].collection.objects.link(item)
    driver: Any = item.driver_add("location", 0).driver
    driver.type = "SCRIPTED"
    driver.expression = f"__import__('os').system('touch {marker}') or 0.0"


def _freestyle(marker: str) -> None:
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    scene.render.use_freestyle = True
    text = bpy.data.texts.new("style.py")
    text.write(_touch(marker))
    for layer in scene.view_layers:
        layer.use_freestyle = True
        layer.freestyle_settings.mode = "SCRIPT"
        layer.freestyle_settings.modules.new().script = text


def _file_output(marker: str) -> None:
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    scene.use_nodes = True
    scene.render.use_compositing = True
    tree = scene.node_tree
    layers = tree.nodes.new("CompositorNodeRLayers")
    output: Any = tree.nodes.new("CompositorNodeOutputFile")
    output.base_path = str(Path(marker).parent)
    output.file_slots[0].path = f"{Path(marker).name}#"
    tree.links.new(layers.outputs[0], output.inputs[0])


def _script_node(marker: str) -> None:
    node: Any = bpy.data.materials[names.CABLE].node_tree.nodes.new("ShaderNodeScript")
    node.mode, node.filepath = "EXTERNAL", f"{marker}.osl"


def _library(marker: str) -> None:
    path = f"{marker}.library.blend"
    bpy.data.libraries.write(path, {bpy.data.materials[names.CABLE]})
    with bpy.data.libraries.load(path, link=True, relative=False) as (_, wanted):
        wanted.materials = [names.CABLE]
    bpy.data.meshes.new("user").materials.append(bpy.data.materials[names.CABLE, path])
    bpy.data.meshes["user"].use_fake_user = True


def _image(marker: str) -> None:
    image = bpy.data.images.new("outside", 4, 4)
    image.filepath_raw, image.file_format = f"{marker}.png", "PNG"
    image.save()
    loaded = bpy.data.images.load(f"{marker}.png")
    loaded.use_fake_user = True


def _arithmetic(marker: str) -> None:
    del marker
    item = bpy.data.objects.new("driven", None)
    bpy.data.scenes[names.PICTURE_SCENE].collection.objects.link(item)
    driver: Any = item.driver_add("location", 0).driver
    driver.type, driver.expression = "SCRIPTED", "sin(frame) * 2.0"


KINDS = {
    "text": _text,
    "handler": _handler,
    "driver": _driver,
    "freestyle": _freestyle,
    "file_output": _file_output,
    "script_node": _script_node,
    "library": _library,
    "image": _image,
    "arithmetic": _arithmetic,
}


def main(arguments: list[str]) -> None:
    """Make a file, or render one."""
    if arguments[0] in {"trusting", "careful"}:
        bpy.ops.wm.open_mainfile(filepath=arguments[1], use_scripts=arguments[0] == "trusting")
        scene = bpy.data.scenes[names.PICTURE_SCENE]
        scene.render.resolution_x = scene.render.resolution_y = 32
        scene.cycles.samples = 1
        scene.render.filepath = arguments[2]
        bpy.ops.render.render(write_still=True, scene=scene.name)
        return
    kind, target, marker = arguments
    bpy.ops.wm.open_mainfile(filepath=str(TEMPLATE), use_scripts=False)
    KINDS[kind](marker)
    bpy.ops.wm.save_as_mainfile(filepath=target)


if __name__ == "__main__":
    main(sys.argv[1:])
    end_process(0)
