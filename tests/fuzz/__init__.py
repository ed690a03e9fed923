"""Hostile bytes for all parsers of the farm."""
