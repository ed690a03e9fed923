"""Blender's cloth as a simulator of cables."""
