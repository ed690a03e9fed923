"""Samples the parts of a scene from the ranges of a style, each with a random generator that is passed in.

"Evenly" means a uniform distribution; none of these modules needs Blender.
"""
