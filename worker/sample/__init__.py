"""Drawing the parts of a scene from the ranges of a style, each from a generator that is passed in. No Blender."""
