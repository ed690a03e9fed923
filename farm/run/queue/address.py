"""The address of a Redis: its form, checked before Celery and redis-py read it, each in its own way.

Of a database that is no number redis-py makes number 0 and Celery a traceback; an option that one knows is an unknown
argument to the other. So an address has one form, and whatever else it holds is refused in one line.
"""

import re
from urllib.parse import parse_qsl

from farm.errors import BrokerError

_FORM = "write redis://HOST:PORT/NUMBER, or redis+socket:///PATH for a socket"
_KINDS = ("redis", "rediss", "redis+socket")
_TLS_OPTIONS = frozenset({"ssl_ca_certs", "ssl_certfile", "ssl_keyfile"})
"""Options of TLS that an address may have, besides `ssl_cert_reqs`, which has one value."""

_PLACE = re.compile(
    r"(?P<host>\[[0-9a-fA-F:.]+(%25\w+)?\]|[^][:/,;%]*)(:(?P<port>\d+))?(/(?P<number>[^/]*)/?)?", re.ASCII
)
_MOST_PORT = 65535
_UNLIKE_OTHERS = {
    "sentinel": "the farm does not ask sentinels; name the primary itself",
    "redis-cluster": "the farm needs a single Redis, no cluster",
    "unix": "a socket is redis+socket:///PATH",
    "http": "",
    "https": "",
    "amqp": "the farm's queue is a Redis",
}


def checked(url: str) -> str:
    """Check an address, and complete it.

    Celery takes `rediss://` without options for TLS with any certificate, so the check is always spelt out here.

    Args:
        url: address as it was given; white space around it is passed over.

    Returns:
        The address, which Celery and redis-py read alike.

    Raises:
        BrokerError: if it is not the address of a Redis, or asks for TLS without a check of the certificate.
    """
    url = url.strip()
    kind, separator, rest = url.partition("://")
    if kind not in _KINDS or not separator:
        why = _UNLIKE_OTHERS.get(kind.lower(), "")
        raise BrokerError(f"'{masked(url)}' is no Redis address; {why}{'; ' if why else ''}{_FORM}")
    if not rest.isprintable() or any(sign.isspace() for sign in rest):
        raise BrokerError(f"'{ascii(masked(url))[1:-1]}' holds white space or a control character; {_FORM}")
    if kind != "rediss":
        # Read as Celery and redis-py read it: all from the first question mark, to a fragment.
        options = parse_qsl(rest.partition("?")[2], keep_blank_values=True)
        if any(key.startswith("ssl") for key, _ in options):
            raise BrokerError(f"'{masked(url)}' has options of TLS but is no address with TLS; write rediss://")
        _refuse_options(url, [key for key, _ in options if (kind, key) != ("redis+socket", "virtual_host")])
    if "#" in rest:
        raise BrokerError(f"'{masked(url)}' holds a #; write %23 for one in a password")
    place, _, query = rest.partition("?")
    if kind == "redis+socket":
        _check_socket(url, place, query)
        return url
    _check_place(url, place)
    return _with_certificate_check(url, query) if kind == "rediss" else url


def _refuse_options(url: str, names: list[str]) -> None:
    if names:
        # A password with a question mark ends here too, so the option isn't quoted.
        raise BrokerError(
            f"'{masked(url)}' has options that no address of the farm's has; {_FORM}, and %3F for a ? in a password"
        )


def _check_place(url: str, place: str) -> None:
    user, _, where = place.rpartition("@")
    found = _PLACE.fullmatch(where)
    if found is None or set(user) & set("/?[]"):
        raise BrokerError(
            f"'{masked(url)}' is not a readable address; {_FORM}; percent-encode signs like / # ? @ in a password"
        )
    if found["port"] and not 1 <= int(found["port"]) <= _MOST_PORT:
        raise BrokerError(f"'{masked(url)}': no port {found['port']}; ports are 1 to {_MOST_PORT}")
    _check_number(url, found["number"] or "")


def _check_socket(url: str, place: str, query: str) -> None:
    if not place.rpartition("@")[2].startswith("/"):
        raise BrokerError(f"'{masked(url)}': a socket needs its whole path: redis+socket:///PATH")
    for _, value in parse_qsl(query, keep_blank_values=True):
        _check_number(url, value)


def _check_number(url: str, text: str) -> None:
    if text and not (text.isascii() and text.isdecimal()):
        raise BrokerError(
            f"'{masked(url)}': {text[:40]!a} is no database; a Redis numbers them from 0, as in redis://HOST:PORT/0"
        )


def _with_certificate_check(url: str, query: str) -> str:
    options = parse_qsl(query, keep_blank_values=True)
    checks = {value for key, value in options if key == "ssl_cert_reqs"}
    if not checks <= {"required", "CERT_REQUIRED"}:
        raise BrokerError(
            f"'{masked(url)}' asks for TLS without a check of the certificate; name your own authority with "
            "ssl_ca_certs=FILE instead"
        )
    if unknown := sorted({key for key, _ in options} - _TLS_OPTIONS - {"ssl_cert_reqs"}):
        raise BrokerError(
            f"'{masked(url)}': unknown option {ascii(unknown[0])[1:-1]}; TLS has {', '.join(sorted(_TLS_OPTIONS))}"
        )
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
