"""The farm's one Celery task."""

import logging
from collections.abc import Callable
from typing import Any

from celery.exceptions import Reject
from celery.worker.request import Request

from farm.errors import FarmError, UnfitWorkerError
from farm.queue.settings import TASK_NAME
from worker.runner import JobRunner, TryLaterError

log = logging.getLogger(__name__)


def register_tasks(app: Any, runner: JobRunner, on_unfit: Callable[[UnfitWorkerError], None]) -> Any:
    """Give the application its task, which hands every message to the runner.

    The runner opens its maker at the first job, so in the pool's child and never before the fork.

    Args:
        app: the Celery application.
        runner: runs the jobs.
        on_unfit: called in the worker's main process, before the message goes back to the queue.

    Returns:
        The task.
    """

    class WatchedRequest(Request):  # type: ignore[misc]  # celery is untyped
        """What the main process knows of a message that a child works on."""

        def on_failure(self, exc_info: Any, send_failed_event: bool = True, return_ok: bool = False) -> Any:
            """Learn from a child that this worker is unfit."""
            error = getattr(exc_info.exception, "exc", exc_info.exception)
            if isinstance(error, Reject) and isinstance(error.reason, UnfitWorkerError):
                on_unfit(error.reason)
            return super().on_failure(exc_info, send_failed_event, return_ok)

    def render_image(task: Any, message: object = None) -> None:
        try:
            log.info("%s", runner.run(message))
        except TryLaterError as error:
            raise task.retry(exc=error, countdown=error.delay_s) from error
        except UnfitWorkerError as error:
            raise Reject(error, requeue=True) from error

    # Failures that the farm foresees are logged in one line, without a traceback.
    options = {"bind": True, "max_retries": None, "throws": (FarmError,), "ignore_result": True}
    return app.task(name=TASK_NAME, Request=WatchedRequest, **options)(render_image)
