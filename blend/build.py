"""Build `template.blend`: `python -m blend.build [FILE]`.

Blender writes memory addresses into its files, so two builds differ in bytes; their content is equal, which
`blend.content` lists and a test compares.
"""

import sys
from pathlib import Path

import bpy

from blend import fall, names
from blend.cable import add_cable, add_skin
from blend.floor import add_floor
from blend.lights import add_camera, add_lamps
from blend.world import add_world

TEMPLATE = Path(__file__).with_name("template.blend")


def build_template(path: Path) -> None:
    """Build the template into `path`, replacing the file only when it is complete."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    picture = bpy.context.scene
    picture.name = names.PICTURE_SCENE
    add_cable(picture)
    add_skin()
    add_floor(picture)
    add_lamps(picture)
    add_camera(picture)
    add_world(picture)
    picture.view_settings.view_transform = "Filmic"
    picture.view_settings.look = "None"
    picture.render.resolution_x = picture.render.resolution_y = 512
    fall.add_fall(bpy.data.scenes.new(fall.SCENE))
    partial = path.with_name(path.name + ".partial")
    bpy.ops.wm.save_as_mainfile(filepath=str(partial), compress=True, copy=True, check_existing=False)
    partial.replace(path)


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else TEMPLATE
    build_template(target)
    sys.stdout.write(f"wrote {target}\n")
