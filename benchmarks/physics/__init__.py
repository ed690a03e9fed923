"""Time against error of all simulators over their settings, on the same drawn scenes."""
