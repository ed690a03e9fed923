"""The camera: its view, its distortion, and the development from linear light to levels."""
