"""The one place that knows under which keys Celery's messages lie in Redis."""

import json
import uuid
from collections.abc import Mapping
from typing import cast

import redis

_QUEUE = "farm"
_UNACKNOWLEDGED = "unacked"
_PRIORITY = "\x06\x16"
"""Stands between a queue's name and a priority."""


def is_queue(key: str) -> bool:
    """Whether a key is that of a list of messages: `farm` or `farm.<dataset>:<12 hex>`, maybe with a priority."""
    name = key.partition(_PRIORITY)[0]
    return name == _QUEUE or name.startswith(f"{_QUEUE}.")


def waiting(client: "redis.Redis") -> Mapping[str, list[str]]:
    """The messages that wait, by the key of their list; the one at the end is taken next.

    Raises:
        redis.RedisError: if Redis is not there.
    """
    # Few keys: a ledger has a dozen.
    keys = [key for key in client.scan_iter(count=1000, _type="list") if is_queue(key)]
    return {key: cast(list[str], client.lrange(key, 0, -1)) for key in sorted(keys)}


def unacknowledged(client: "redis.Redis") -> int:
    """How many messages workers have taken and neither done nor given back.

    Raises:
        redis.RedisError: if Redis is not there.
    """
    return int(client.hlen(_UNACKNOWLEDGED))


def job_of(message: str) -> str | None:
    """The id of the job that a message asks for; None if it is none of the farm's."""
    try:
        return str(json.loads(message)["headers"]["id"]).rpartition(":")[2]
    except (ValueError, TypeError, KeyError):
        return None


def redelivered(message: str) -> str:
    """The message as another delivery of the same task."""
    envelope = json.loads(message)
    envelope["properties"]["delivery_tag"] = str(uuid.uuid4())
    return json.dumps(envelope)
