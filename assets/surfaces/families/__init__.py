"""Recipes of floor surfaces, a module a family."""
