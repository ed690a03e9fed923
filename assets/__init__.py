"""The assets of a scene: floors, textures and surroundings, made here or read from the user's folders."""
