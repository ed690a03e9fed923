"""Scanners of the user's own files: panoramas, textures, photographs."""
