"""Measure the cost of a whole picture, from the draw of its scene to its files, beside other methods and settings."""
