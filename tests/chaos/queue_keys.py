"""The only module that knows the keys of Celery's messages in Redis."""

import json
import uuid
from collections.abc import Mapping
from typing import cast

import redis

_QUEUE = "farm"
_UNACKNOWLEDGED = "unacked"
_PRIORITY = "\x06\x16"
"""Separator between the name of a queue and a priority in a key."""


def is_queue(key: str) -> bool:
    """Whether a key is a list of messages: `farm` or `farm.<dataset>:<12 hex>`, possibly with a priority."""
    name = key.partition(_PRIORITY)[0]
    return name == _QUEUE or name.startswith(f"{_QUEUE}.")


def waiting(client: "redis.Redis") -> Mapping[str, list[str]]:
    """The waiting messages by the key of their list; the last one of a list is taken next.

    Raises:
        redis.RedisError: if Redis can't be reached.
    """
    # There are few keys: a ledger has a dozen.
    keys = [key for key in client.scan_iter(count=1000, _type="list") if is_queue(key)]
    return {key: cast(list[str], client.lrange(key, 0, -1)) for key in sorted(keys)}


def unacknowledged(client: "redis.Redis") -> int:
    """Number of messages that workers have taken and neither finished nor returned.

    Raises:
        redis.RedisError: if Redis can't be reached.
    """
    return int(client.hlen(_UNACKNOWLEDGED))


def job_of(message: str) -> str | None:
    """The id of the job that a message asks for; None if it isn't a message of the farm."""
    try:
        return str(json.loads(message)["headers"]["id"]).rpartition(":")[2]
    except (ValueError, TypeError, KeyError):
        return None


def redelivered(message: str) -> str:
    """The message as another delivery of the same task."""
    envelope = json.loads(message)
    envelope["properties"]["delivery_tag"] = str(uuid.uuid4())
    return json.dumps(envelope)
