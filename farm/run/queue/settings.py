"""The Celery application, with every setting that the farm relies on."""

from typing import Any

from celery import Celery
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


def make_app(broker_url: str) -> Any:
    """Make a Celery application that sends and takes the farm's one task; nothing is connected yet."""
    app = Celery("farm", broker=broker_url, set_as_current=False)
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
