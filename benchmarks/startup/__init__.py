"""Measure the time from a worker's start to its first picture, step by step."""
