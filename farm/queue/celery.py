"""Celery's queue, seen from the coordinator: sending tasks by name, and looking at those that wait."""

import json
from collections.abc import Iterable
from typing import Any, cast

import redis
from kombu.exceptions import OperationalError

from farm.errors import BrokerError
from farm.job import JobMessage, queue_key
from farm.queue.settings import QUEUE, TASK_NAME

_PAGE = 500


class CeleryQueue:
    """Implements `farm.queue.port.JobQueue`.

    Args:
        app: from `make_app`.
        client: a client of the same Redis, with `decode_responses=True`.
    """

    def __init__(self, app: Any, client: "redis.Redis") -> None:
        self._app = app
        self._client = client

    def submit(self, messages: Iterable[JobMessage]) -> int:
        """See `JobQueue.submit`."""
        count = 0
        try:
            with self._app.producer_pool.acquire(block=True) as producer:
                for message in messages:
                    self._app.send_task(
                        TASK_NAME,
                        kwargs={"message": message.encode()},
                        task_id=message.task_id,
                        queue=QUEUE,
                        producer=producer,
                        retry=False,
                        # Flower shows these instead of the whole message.
                        argsrepr=message.dataset,
                        kwargsrepr=message.job_id,
                    )
                    count += 1
        except (OperationalError, redis.RedisError) as error:
            raise BrokerError(
                f"Redis went away after {count} jobs were queued: {error}; submit again, nothing is doubled"
            ) from error
        return count

    def length(self) -> int:
        """See `JobQueue.length`."""
        try:
            return int(self._client.llen(QUEUE))
        except redis.RedisError as error:
            raise BrokerError(f"can't look at the queue: {error}") from error

    def queued(self, dataset: str, spec_sha256: str) -> set[str]:
        """See `JobQueue.queued`. Messages enter on the left, so reading from there misses none that stays."""
        asked = queue_key(dataset, spec_sha256)
        found: set[str] = set()
        start = 0
        try:
            while page := cast(list[str], self._client.lrange(QUEUE, start, start + _PAGE - 1)):
                found.update(job_id for key, job_id in map(_names, page) if key == asked)
                start += _PAGE
        except redis.RedisError as error:
            raise BrokerError(f"can't look at the queue: {error}") from error
        return found


def _names(envelope: str) -> tuple[str, str]:
    # The task's id is in the envelope's headers, so the body need not be decoded. Foreign messages are passed over.
    try:
        key, _, job_id = str(json.loads(envelope)["headers"]["id"]).rpartition(":")
    except (ValueError, TypeError, KeyError):
        return "", ""
    return key, job_id
