"""The Blender side of a picture: every module here may import bpy."""
