"""Clutter, the objects on the floor that are not cables: images of sheets, meshes of sticks and small parts."""
