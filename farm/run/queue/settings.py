"""The Celery application, with every setting that the farm relies on."""

from typing import Any

from celery import Celery
from celery.loaders.app import AppLoader
from kombu.entity import Queue

from farm.run.registry.port import PRIORITY_STEPS, Priority
from farm.run.worker_settings import HARD_LIMIT_S, MEMORY_PER_CHILD_KIB, TASKS_PER_CHILD

TASK_NAME = "farm.render_image"

QUEUE = "farm"
"""The queue that every worker listens to. Each run has a queue of its own, which workers join as it is registered."""

SOFT_LIMIT_S = 25 * 60
"""Seconds after which a job is asked to stop, if it can be asked: less than the longest hard limit."""

VISIBILITY_S = 2 * 3600
"""Seconds after which Redis gives an unacknowledged message to another worker: well over the hard limit."""


def queue_name(run_key: str) -> str:
    """Name the queue of a run's jobs."""
    return f"{QUEUE}.{run_key}"


class _Loader(AppLoader):  # type: ignore[misc]  # celery is untyped
    """Reads no module of settings: CELERY_CONFIG_MODULE names that of another program."""

    def read_configuration(self, env: str = "") -> dict[str, object]:
        """Find no settings."""
        del env
        return {}


class _App(Celery):  # type: ignore[misc]  # celery is untyped
    """An application that keeps to its broker: Celery's own puts CELERY_BROKER_URL before every setting."""

    # Without results there is no backend, whatever CELERY_RESULT_BACKEND says.
    backend_cls = "disabled://"

    def __init__(self, broker_url: str) -> None:
        # A fix-up would import the Django site that DJANGO_SETTINGS_MODULE names.
        super().__init__("farm", broker=broker_url, loader=_Loader, fixups=(), set_as_current=False)
        self._farm_broker_url = broker_url

    def connection(self, url: str | None = None, **options: Any) -> Any:
        """Connect to the farm's Redis."""
        return super().connection(url or self._farm_broker_url, **options)

    def connection_for_read(self, url: str | None = None, **options: Any) -> Any:
        """Connect to the farm's Redis."""
        return super().connection_for_read(url or self._farm_broker_url, **options)

    def connection_for_write(self, url: str | None = None, **options: Any) -> Any:
        """Connect to the farm's Redis."""
        return super().connection_for_write(url or self._farm_broker_url, **options)


def make_app(broker_url: str) -> Any:
    """Make a Celery application that sends and takes the farm's one task; nothing is connected yet."""
    app = _App(broker_url)
    app.conf.update(
        accept_content=["json"],
        task_serializer="json",
        task_default_queue=QUEUE,
        task_queues=[Queue(QUEUE)],  # type: ignore[no-untyped-call]  # kombu is typed in parts
        # Without results there is no backend: the folder tells what is done.
        task_ignore_result=True,
        # A message is given back when its worker dies, and a worker holds no more than it works on.
        task_acks_late=True,
        task_reject_on_worker_lost=True,
        # The same at the hard limit; the ledger bounds how often a job is begun.
        task_acks_on_failure_or_timeout=False,
        worker_prefetch_multiplier=1,
        task_soft_time_limit=SOFT_LIMIT_S,
        task_time_limit=HARD_LIMIT_S,
        broker_transport_options={
            "visibility_timeout": VISIBILITY_S,
            "socket_connect_timeout": 5,
            # A Redis that no longer answers must not keep a worker from ending; it answers a waiting one every second.
            "socket_timeout": 10,
            # A worker takes from its queues in turn, all those of one priority before any of the next.
            "priority_steps": PRIORITY_STEPS,
            "queue_order_strategy": "round_robin",
        },
        # A farm waits for its Redis for as long as it takes.
        broker_connection_retry_on_startup=True,
        broker_connection_max_retries=None,
        task_default_priority=Priority.NORMAL.step,
        worker_max_tasks_per_child=TASKS_PER_CHILD,
        worker_max_memory_per_child=MEMORY_PER_CHILD_KIB,
        # Flower shows these events.
        worker_send_task_events=True,
        # An event for each submitted job would double what a submission costs.
        task_send_sent_event=False,
        # Blender writes to the descriptors themselves; the child's are sent to its log instead.
        worker_redirect_stdouts=False,
        worker_hijack_root_logger=False,
        enable_utc=True,
    )
    return app
