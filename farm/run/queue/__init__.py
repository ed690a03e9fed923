"""The way to the workers: Celery over Redis, JSON only, one task by name."""
