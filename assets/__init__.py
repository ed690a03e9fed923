"""Floors, textures and surroundings: what a scene is dressed with, made here or read from the user's folders."""
