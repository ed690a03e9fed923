"""Benchmarks: commands that print a table, write JSON, and fail on wrong results, never on slow ones."""
