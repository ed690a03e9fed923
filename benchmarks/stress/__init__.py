"""Stress test of the rod solver: many falls over the whole range of every parameter, with starts that no scene has."""
