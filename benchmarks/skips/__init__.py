"""Measure the time saved by leaving out what a picture's scene doesn't need."""
