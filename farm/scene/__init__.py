"""One drawn scene: every random value of a picture, free of Blender."""
