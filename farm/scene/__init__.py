"""The model of a scene: every random value of one picture, in modules by subject. It knows nothing of Blender."""
