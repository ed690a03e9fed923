"""One worker process: Celery's main process, the child that runs jobs, and what keeps both honest."""
