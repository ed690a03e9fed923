"""The camera: its view, its lens's distortion, and the development of linear light to 8-bit levels."""
