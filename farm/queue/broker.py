"""The broker's address, and a direct line to it."""

import os

import redis
from redis.backoff import NoBackoff
from redis.retry import Retry

from farm.errors import BrokerError

DEFAULT_BROKER_URL = "redis://localhost:6379/0"
BROKER_VARIABLE = "FARM_BROKER_URL"

_CONNECT_S = 2.0
_ANSWER_S = 10.0
_KINDS = ("redis", "rediss", "redis+socket")


def broker_url(given: str | None) -> str:
    """The address given, else that of the environment, else the local default.

    Raises:
        BrokerError: if it is not the address of a Redis.
    """
    url = given or os.environ.get(BROKER_VARIABLE) or DEFAULT_BROKER_URL
    if url.partition("://")[0] not in _KINDS:
        raise BrokerError(
            f"'{masked(url)}' is no Redis address; write redis://HOST:PORT/NUMBER, or redis+socket:///PATH for a socket"
        )
    return url


def masked(url: str) -> str:
    """The address without what may be a password, for messages: all before the last `@`, and the query.

    It is not parsed, as a password may hold any sign, and an address that can't be parsed must not be shown whole.
    """
    kind, separator, rest = url.partition("://")
    if not separator:
        return "(no address)"
    _, at, place = rest.rpartition("@")
    shown = place.partition("?")[0].partition("#")[0]
    return f"{kind}://***@{shown}" if at else f"{kind}://{shown}"


def connect(url: str) -> "redis.Redis":
    """A client of a Redis that has answered. Whether it does is told within seconds, as people wait for it.

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
            address, decode_responses=True, socket_connect_timeout=_CONNECT_S, socket_timeout=_ANSWER_S
        )
    except ValueError:
        # The parser's own words may quote a part of the password.
        raise BrokerError(
            f"no Redis at {masked(url)}: not a readable address; percent-encode signs like / # ? @ in a password"
        ) from None
    except (redis.RedisError, OSError) as error:
        raise BrokerError(
            f"no Redis at {masked(url)}: {_one_line(error)}; start one, or name it with --broker or {BROKER_VARIABLE}"
        ) from error
    return client


def _one_line(error: Exception) -> str:
    return str(error).partition("\n")[0].rstrip(". ")
