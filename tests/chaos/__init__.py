"""Seeded faults against a whole farm: real Redis, real Celery workers, a real coordinator; `python -m tests.chaos`."""
