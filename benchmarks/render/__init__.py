"""Measure time against error of rendering."""
