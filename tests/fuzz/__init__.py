"""Hostile bytes for everything that the farm parses."""
