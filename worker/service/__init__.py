"""A worker: Celery's main process, the child that runs jobs, and the supervisor, leases and watchdog over both."""
