"""The farm's one Celery task."""

import logging
import os
import time
from typing import Any

from billiard.exceptions import WorkerLostError
from celery.exceptions import Ignore, Reject
from celery.worker.request import Request

from farm.errors import BrokerError, DestinationError, FarmError, UnfitWorkerError
from farm.run.queue.settings import TASK_NAME
from worker.service.failures import TryLaterError
from worker.service.runner import JobRunner
from worker.service.supervisor import Supervisor

log = logging.getLogger(__name__)

_BROKER_PAUSE_S = (0.5, 2.0)
"""Shortest and longest pause, in seconds, before a message goes back after a failure of Redis."""


def _broker_pause_s(process: int) -> float:
    """A pause that differs between a machine's processes, so that they don't come back to Redis all at once."""
    least, most = _BROKER_PAUSE_S
    return least + (most - least) * (process % 100) / 100


def register_tasks(app: Any, runner: JobRunner, supervisor: Supervisor) -> Any:
    """Give the application its task, which hands every message to the runner.

    The runner opens its renderer at the first job, so in the pool's child and never before the fork.

    Args:
        app: the Celery application.
        runner: runner of the jobs, in the children.
        supervisor: supervisor in the main process, which is told how jobs end.

    Returns:
        The task.
    """

    class WatchedRequest(Request):  # type: ignore[misc]  # celery is untyped
        """A message that a child works on, as the main process sees it; it tells the supervisor how the job ends."""

        failed = False

        def acknowledge(self) -> Any:
            """Tell the supervisor that a picture was made: Celery overrides `on_success`, but acknowledges in it."""
            if not self.failed:
                supervisor.note_done()
            return super().acknowledge()

        def on_failure(self, exc_info: Any, send_failed_event: bool = True, return_ok: bool = False) -> Any:
            """Tell the supervisor if this worker is unfit, its store full, or its child dead."""
            self.failed = True
            error = getattr(exc_info.exception, "exc", exc_info.exception)
            if isinstance(error, Reject) and isinstance(error.reason, UnfitWorkerError):
                supervisor.note_unfit(error.reason)
            elif isinstance(error, Reject) and isinstance(error.reason, DestinationError):
                supervisor.note_full(error.reason)
            elif isinstance(error, WorkerLostError | SystemExit):
                supervisor.note_crash(self)
            return super().on_failure(exc_info, send_failed_event, return_ok)

        def on_timeout(self, soft: bool, timeout: float) -> Any:
            """Tell the supervisor if a child is about to be killed at the hard limit."""
            if not soft:
                self.failed = True
                supervisor.note_crash(self)
            return super().on_timeout(soft, timeout)

    def render_image(task: Any, message: object = None) -> None:
        try:
            outcome = runner.run(message)
            log.info("%s", outcome.said)
            if not outcome.made:
                raise Ignore
        except TryLaterError as error:
            raise task.retry(exc=error, countdown=error.delay_s) from error
        except (UnfitWorkerError, DestinationError) as error:
            raise Reject(error, requeue=True) from error
        except BrokerError as error:
            time.sleep(_broker_pause_s(os.getpid()))
            raise Reject(error, requeue=True) from error

    # Failures that the farm foresees are logged in one line, without a traceback.
    options = {"bind": True, "max_retries": None, "throws": (FarmError,), "ignore_result": True}
    return app.task(name=TASK_NAME, Request=WatchedRequest, **options)(render_image)
