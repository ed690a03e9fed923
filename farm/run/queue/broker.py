"""The broker's address, and a Redis client for it."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import cast

import redis
from redis.backoff import NoBackoff
from redis.retry import Retry

from farm.errors import BrokerError
from farm.run.queue.address import checked, masked
from farm.run.queue.refusals import explained, meaning

DEFAULT_BROKER_URL = "redis://localhost:6379/0"
BROKER_VARIABLE = "FARM_BROKER_URL"
BROKER_FILE_VARIABLE = "FARM_BROKER_URL_FILE"
"""Variable that names a file with the address: containers get their secrets as files."""

_PROBE = "farm:probe"
"""Key that is written to see whether a Redis takes writes."""

_CONNECT_S = 2.0
_ANSWER_S = 10.0


def broker_url(given: str | None) -> str:
    """Choose the given address, else that of the environment, of the file that it names, or `DEFAULT_BROKER_URL`.

    Raises:
        BrokerError: if it is not the address of a Redis, or asks for TLS without a check of the certificate.
    """
    if given is not None and not given.strip():
        # Such as that of an unset variable of a shell: the default would be another person's Redis.
        raise BrokerError("--broker is empty; name a Redis, as in redis://HOST:PORT/NUMBER, or leave the option out")
    return checked(given or os.environ.get(BROKER_VARIABLE) or _from_file() or DEFAULT_BROKER_URL)


def is_named() -> bool:
    """Whether the environment names a Redis."""
    return any(os.environ.get(name) for name in (BROKER_VARIABLE, BROKER_FILE_VARIABLE))


def _from_file() -> str | None:
    path = os.environ.get(BROKER_FILE_VARIABLE)
    if not path:
        return None
    try:
        return Path(path).read_text("utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "is no text"
        raise BrokerError(f"{path}: can't read the broker's address: {reason}; see {BROKER_FILE_VARIABLE}") from None


def connect(url: str) -> "redis.Redis":
    """Make a client of a Redis once it has answered. One that is not there is reported within seconds, as people wait.

    Raises:
        BrokerError: if Redis is not there or refuses.
    """
    # redis-py and Celery spell the address of a Unix socket differently.
    address = url.replace("redis+socket://", "unix://", 1).replace("virtual_host=", "db=")
    try:
        first = redis.Redis.from_url(
            address, socket_connect_timeout=_CONNECT_S, socket_timeout=_CONNECT_S, retry=Retry(NoBackoff(), 0)
        )
        first.ping()
        first.close()
        client = redis.Redis.from_url(
            address,
            decode_responses=True,
            socket_connect_timeout=_CONNECT_S,
            socket_timeout=_ANSWER_S,
            # One retry, as a connection may have been lost since its last use. Callers know how long to wait.
            retry=Retry(NoBackoff(), 1),
        )
    except (ValueError, TypeError):
        # The parser's own words may quote a part of the password.
        raise BrokerError(
            f"no Redis at {masked(url)}: not a readable address; percent-encode signs like / # ? @ in a password"
        ) from None
    except (redis.RedisError, OSError) as error:
        if meaning(error) is not None:
            raise BrokerError(f"{masked(url)}: {explained(error)}") from error
        raise BrokerError(
            f"no Redis at {masked(url)}: {_one_line(error)}; start one, or name it with --broker or {BROKER_VARIABLE}"
        ) from error
    return client


def connect_to_write(url: str) -> "redis.Redis":
    """Make a client of a Redis once it has taken a write, as a farm needs it: before anything else is written.

    Raises:
        BrokerError: if Redis is not there, or is a replica, a node of a cluster, full, or otherwise refuses.
    """
    client = connect(url)
    try:
        with client.pipeline(transaction=False) as probe:
            probe.set(_PROBE, "", ex=1)
            # Two keys, which a cluster keeps on different servers.
            probe.delete(_PROBE, f"{_PROBE}:2")
            probe.execute()
    except (redis.RedisError, OSError) as error:
        client.close()
        raise BrokerError(f"{masked(url)}: {explained(error)}") from error
    return client


def policy_of(client: "redis.Redis") -> str | None:
    """Ask a Redis which keys it forgets when its memory is full; None if this user may not ask.

    A Redis without a limit of its memory never forgets: `noeviction`.
    """
    try:
        memory = cast(dict[str, object], client.info("memory"))
    except redis.ResponseError:
        return None
    return str(memory.get("maxmemory_policy")) if memory.get("maxmemory") else "noeviction"


@contextmanager
def as_broker_error() -> Iterator[None]:
    """Turn what a client raises inside `with` into the farm's own error.

    Raises:
        BrokerError: if Redis refuses, or went away.
    """
    try:
        yield
    except (redis.RedisError, UnicodeDecodeError) as error:
        if isinstance(error, redis.RedisError) and meaning(error) is not None:
            raise BrokerError(explained(error)) from error
        raise BrokerError(f"Redis refused, went away or holds what is no text: {error}") from error


def wait_for(url: str, patience_s: float) -> None:
    """Wait until a Redis takes writes.

    Raises:
        BrokerError: if it does not within `patience_s` seconds; it is asked at least once.
    """
    give_up_s = time.monotonic() + patience_s
    while True:
        try:
            connect_to_write(url).close()
            return
        except BrokerError:
            if time.monotonic() >= give_up_s:
                raise
            time.sleep(1.0)


def _one_line(error: Exception) -> str:
    return str(error).partition("\n")[0].rstrip(". ")
