"""The farm's one Celery task."""

import logging
from typing import Any

from farm.errors import FarmError
from farm.queue.settings import TASK_NAME
from worker.runner import JobRunner, TryLaterError

log = logging.getLogger(__name__)


def register_tasks(app: Any, runner: JobRunner) -> Any:
    """Give the application its task, which hands every message to the runner.

    The runner opens its maker at the first job, so in the pool's child and never before the fork.

    Returns:
        The task.
    """

    def render_image(task: Any, message: object = None) -> None:
        try:
            log.info("%s", runner.run(message))
        except TryLaterError as error:
            raise task.retry(exc=error, countdown=error.delay_s) from error

    # Failures that the farm foresees are logged in one line, without a traceback.
    return app.task(name=TASK_NAME, bind=True, max_retries=None, throws=(FarmError,), ignore_result=True)(render_image)
