"""Benchmarks: each prints a table, writes JSON, and fails if a result is wrong, never because it is slow."""
