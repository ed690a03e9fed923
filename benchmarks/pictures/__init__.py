"""Measure the look of a style's pictures, and compare it with published examples and photographs."""
