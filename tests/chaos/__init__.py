"""Seeded faults against a whole farm, with real Redis, real Celery workers and a real coordinator.

`python -m tests.chaos` runs them.
"""
