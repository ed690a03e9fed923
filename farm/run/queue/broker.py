"""The broker's address, and a Redis client for it."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import parse_qsl

import redis
from redis.backoff import NoBackoff
from redis.retry import Retry

from farm.errors import BrokerError

DEFAULT_BROKER_URL = "redis://localhost:6379/0"
BROKER_VARIABLE = "FARM_BROKER_URL"
BROKER_FILE_VARIABLE = "FARM_BROKER_URL_FILE"
"""Variable that names a file with the address: containers get their secrets as files."""

_CONNECT_S = 2.0
_ANSWER_S = 10.0
_KINDS = ("redis", "rediss", "redis+socket")

_TLS_OPTIONS = frozenset({"ssl_ca_certs", "ssl_certfile", "ssl_keyfile"})
"""Options of TLS that an address may have, besides `ssl_cert_reqs`, which has one value."""


def broker_url(given: str | None) -> str:
    """Choose the given address, else that of the environment, of the file that it names, or `DEFAULT_BROKER_URL`.

    Celery takes `rediss://` without options for TLS with any certificate, so the check is always spelt out here.

    Raises:
        BrokerError: if it is not the address of a Redis, or asks for TLS without a check of the certificate.
    """
    url = given or os.environ.get(BROKER_VARIABLE) or _from_file() or DEFAULT_BROKER_URL
    kind = url.partition("://")[0]
    if kind not in _KINDS:
        raise BrokerError(
            f"'{masked(url)}' is no Redis address; write redis://HOST:PORT/NUMBER, or redis+socket:///PATH for a socket"
        )
    return _with_certificate_check(url, kind)


def _from_file() -> str | None:
    path = os.environ.get(BROKER_FILE_VARIABLE)
    if not path:
        return None
    try:
        return Path(path).read_text("utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "is no text"
        raise BrokerError(f"{path}: can't read the broker's address: {reason}; see {BROKER_FILE_VARIABLE}") from None


def _with_certificate_check(url: str, kind: str) -> str:
    # Read as Celery and redis-py read it: all from the first question mark, to a fragment.
    query = url.partition("?")[2]
    options = [(key, value) for key, value in parse_qsl(query, keep_blank_values=True) if key.startswith("ssl")]
    if kind != "rediss":
        if options:
            raise BrokerError(f"'{masked(url)}' has options of TLS but is no address with TLS; write rediss://")
        return url
    if "#" in url:
        raise BrokerError(f"'{masked(url)}' holds a #; write %23 for one in a password")
    checks = {value for key, value in options if key == "ssl_cert_reqs"}
    if not checks <= {"required", "CERT_REQUIRED"}:
        raise BrokerError(
            f"'{masked(url)}' asks for TLS without a check of the certificate; name your own authority with "
            "ssl_ca_certs=FILE instead"
        )
    if unknown := sorted({key for key, _ in options} - _TLS_OPTIONS - {"ssl_cert_reqs"}):
        raise BrokerError(f"'{masked(url)}': unknown option {unknown[0]}; TLS has {', '.join(sorted(_TLS_OPTIONS))}")
    # Celery knows the long word, redis-py the short one alone.
    spelt = url.replace("ssl_cert_reqs=CERT_REQUIRED", "ssl_cert_reqs=required")
    return spelt if checks else f"{url}{'&' if query else '?'}ssl_cert_reqs=required"


def masked(url: str) -> str:
    """Mask an address for messages: leave out the part before the last `@` and the query, which may hold passwords.

    It is not parsed: a password may hold any sign, and an address that can't be parsed must not be shown whole.
    """
    kind, separator, rest = url.partition("://")
    if not separator:
        return "(no address)"
    _, at, place = rest.rpartition("@")
    shown = place.partition("?")[0].partition("#")[0]
    return f"{kind}://***@{shown}" if at else f"{kind}://{shown}"


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


@contextmanager
def as_broker_error() -> Iterator[None]:
    """Turn what a client raises inside `with` into the farm's own error.

    Raises:
        BrokerError: if Redis refuses, or went away.
    """
    try:
        yield
    except (redis.RedisError, UnicodeDecodeError) as error:
        raise BrokerError(f"Redis refused, went away or holds what is no text: {error}") from error


def wait_for(url: str, patience_s: float) -> None:
    """Wait until a Redis answers.

    Raises:
        BrokerError: if it does not answer within `patience_s` seconds; it is asked at least once.
    """
    give_up_s = time.monotonic() + patience_s
    while True:
        try:
            connect(url).close()
            return
        except BrokerError:
            if time.monotonic() >= give_up_s:
                raise
            time.sleep(1.0)


def _one_line(error: Exception) -> str:
    return str(error).partition("\n")[0].rstrip(". ")
