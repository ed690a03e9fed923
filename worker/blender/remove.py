"""Removing what was added to the template for the picture before."""

import bpy


def remove_blocks(prefix: str) -> None:
    """Remove all objects, meshes, materials and lights whose names start with a prefix."""
    for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.lights):
        for block in [block for block in collection if block.name.startswith(prefix)]:
            collection.remove(block)
