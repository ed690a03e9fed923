"""Measure the cost of rendering each floor surface, relative to a plain one."""
