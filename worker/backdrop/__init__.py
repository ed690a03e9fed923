"""The backdrop, which is what the camera sees behind far cables: part of an HDRI, or of a photograph."""
