"""Time against error of all simulators and their settings, on the same drawn scenes."""
