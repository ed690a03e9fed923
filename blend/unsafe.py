"""The check that a template holds no code and needs no files beside itself.

A template is opened with its scripts left off, so none of this would act; but its author should know that, and a
picture must not depend on files that the dataset's header has no checksum of.
"""

from collections.abc import Iterator
from typing import Any

import bpy


def find_unsafe() -> Iterator[str]:
    """Yield each piece of code and each outside file of the open file, as a phrase; nothing if it is only a scene."""
    for text in bpy.data.texts:
        if text.use_module:
            yield f"the text '{text.name}' that is to run at the start"
    for scene in bpy.data.scenes:
        if any(layer.freestyle_settings.mode == "SCRIPT" for layer in scene.view_layers):
            yield f"Freestyle scripts in the scene '{scene.name}'"
    for block in _blocks():
        name = f"'{block.name}'"
        if any(_is_python(driver.driver) for driver in _drivers(block)):
            yield f"a driver in Python on {name}; arithmetic alone is allowed"
        tree = block if isinstance(block, bpy.types.NodeTree) else getattr(block, "node_tree", None)
        if tree is not None and any(node.type == "SCRIPT" for node in tree.nodes):
            yield f"a script node in {name}"
    for path in sorted(set(bpy.utils.blend_paths(absolute=False, packed=False, local=False))):
        yield f"the outside file {path!a}; pack it into the template (File > External Data)"


def _blocks() -> Iterator[Any]:
    """Yield every data block of the file, the node trees within materials and the like included."""
    for definition in bpy.data.bl_rna.properties:
        if definition.type != "COLLECTION":
            continue
        for block in getattr(bpy.data, definition.identifier):
            yield block
            for inner in ("node_tree", "shape_keys"):
                if getattr(block, inner, None) is not None:
                    yield getattr(block, inner)


def _drivers(block: Any) -> Any:
    animation = getattr(block, "animation_data", None)
    return animation.drivers if animation is not None else ()


def _is_python(driver: Any) -> bool:
    return bool(driver.type == "SCRIPTED" and not driver.is_simple_expression)
