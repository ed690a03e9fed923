"""Rooms and yards of our own, built from a seed: what is seen behind cables, and lights them."""
