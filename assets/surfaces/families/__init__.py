"""Recipes of floor surfaces, one module per family."""
