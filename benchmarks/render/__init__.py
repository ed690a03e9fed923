"""Time against error of rendering."""
