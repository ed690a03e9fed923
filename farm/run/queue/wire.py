"""The gate that a worker's messages go through before Celery sees them: size, nesting, form, and the one task.

Whoever can write to Redis can put anything into a queue. Celery parses a message of any size and depth, ends on some
malformed ones, and lets a message bring calls to make afterwards, time limits and times of its own. Here such a
message is dropped with one line in the log; Redis has handed it out, so it does not come back.
"""

import base64
import json
import logging
import re
from datetime import datetime
from queue import Empty
from typing import Annotated, Any, Literal

import kombu.transport
import kombu.transport.redis
from kombu import serialization
from kombu.utils import json as kombu_json
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from farm.errors import MessageError
from farm.run.queue.settings import TASK_NAME

BODY_BYTES = 64 * 1024
"""Bytes of a message's body above which it is dropped. A farm's message has about 300."""

ENVELOPE_BYTES = 2 * BODY_BYTES
"""Bytes of a whole message, with its headers and its body in base64, above which it is dropped."""

NESTING = 16
"""Depth of nested brackets above which a message is dropped. A farm's message has 4."""

_RESTORED_BYTES = 8 * ENVELOPE_BYTES  # beside its message it holds the queue's name, and escapes may have been added

_BRACKETS = re.compile(r'"(?:[^"\\]|\\.)*"?|(?P<open>[\[{])|(?P<close>[\]}])', re.DOTALL)

log = logging.getLogger(__name__)


def decode_json(data: str | bytes | bytearray | memoryview, limit: int = BODY_BYTES) -> Any:
    """Parse JSON that may come from anybody; its size and nesting are checked first.

    Args:
        data: the text as received.
        limit: bytes above which the text is not parsed.

    Raises:
        MessageError: if it is too large or too deep, holds a key twice or a number that is none, or is no JSON.
    """
    if len(data) > limit:
        raise MessageError(f"message refused: {len(data)} bytes are more than {limit}")
    try:
        text = data if isinstance(data, str) else bytes(data).decode("utf-8")
        if _nesting(text) > NESTING:
            raise MessageError(f"message refused: nested deeper than {NESTING}")
        return json.loads(text, object_pairs_hook=_without_doubles, parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise MessageError(f"message refused: no JSON: {error}"[:200]) from None


def _nesting(text: str) -> int:
    deepest = depth = 0
    for found in _BRACKETS.finditer(text):
        depth += (found["open"] is not None) - (found["close"] is not None)
        deepest = max(deepest, depth)
    return deepest


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) != len(pairs):
        raise ValueError("a key stands twice in one object")
    return members


def _no_number(name: str) -> None:
    raise ValueError(f"{name} is no number of JSON")


_Id = Annotated[str, Field(pattern=r"^[!-~]{1,250}$")]
"""An id without spaces and line breaks, as logs show it."""

_Shown = Annotated[str, Field(max_length=250, pattern=r"^[ -~]*$")]


class _Part(BaseModel):
    """A part of an envelope. Celery adds much that no farm needs; only the known parts are handed on."""

    model_config = ConfigDict(extra="ignore", strict=True, allow_inf_nan=False)


class _Headers(_Part):
    task: Literal["farm.render_image"]
    id: _Id
    root_id: _Id | None = None
    parent_id: _Id | None = None
    eta: Annotated[str, Field(max_length=40)] | None = None
    retries: Annotated[int, Field(ge=0, le=10**6)] = 0
    argsrepr: _Shown = ""
    kwargsrepr: _Shown = ""
    origin: _Shown | None = None
    lang: _Shown | None = None


class _Address(_Part):
    exchange: Annotated[str, Field(max_length=250)]
    routing_key: Annotated[str, Field(max_length=250)]
    redelivered: bool = False


class _Properties(_Part):
    delivery_tag: _Id
    delivery_info: _Address
    body_encoding: Literal["base64"]
    delivery_mode: Annotated[int, Field(ge=1, le=2)] = 2
    priority: Annotated[int, Field(ge=0, le=255)] = 0
    correlation_id: _Id | None = None
    reply_to: _Id | None = None


class _Envelope(_Part):
    headers: _Headers
    properties: _Properties
    body: str
    content_type: Literal["application/json"] = Field(alias="content-type")
    content_encoding: Literal["utf-8"] = Field(alias="content-encoding")


class _Control(_Part):
    headers: dict[str, Any]
    properties: dict[str, Any]
    body: str
    content_type: Literal["application/json"] = Field(alias="content-type")
    content_encoding: Literal["utf-8"] = Field(alias="content-encoding")


assert TASK_NAME == "farm.render_image"  # noqa: S101  # a Literal can't be made from the name


def checked_envelope(message: object) -> dict[str, Any]:
    """Check a message from a job queue, and keep the parts that Celery may see.

    Args:
        message: the envelope, parsed.

    Returns:
        The envelope with its known parts alone.

    Raises:
        MessageError: if it is not a plain call of the farm's task.
    """
    try:
        envelope = _Envelope.model_validate(message)
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(str(part) for part in first["loc"]) or "envelope"
        raise MessageError(f"message refused: {where}: {first['msg']}"[:200]) from None
    _check_eta(envelope.headers.eta)
    try:
        body = base64.b64decode(envelope.body, validate=True)
    except ValueError:
        raise MessageError("message refused: body: not in base64") from None
    _check_call(decode_json(body))
    return envelope.model_dump(by_alias=True)


def _check_eta(eta: str | None) -> None:
    try:
        if eta is not None:
            datetime.fromisoformat(eta)
    except ValueError:
        raise MessageError("message refused: headers.eta: no time") from None


def _check_call(body: object) -> None:
    """Check a body (arguments, named arguments, later calls): a farm's call has one named argument and nothing else."""
    match body:
        case [[], {"message": _, **others}, dict() as embedded] if not others and not any(embedded.values()):
            return
    raise MessageError("message refused: body: not a plain call with one message")


class _GuardedQoS(kombu.transport.redis.QoS):
    """Keeps the messages that a worker holds, and puts back those of a worker that died."""

    def restore_by_tag(self, tag: Any, client: Any = None, leftmost: bool = False) -> None:
        """Put one back; one that can't be read is forgotten, as it would keep every worker from starting."""
        untyped: Any = super()
        try:
            untyped.restore_by_tag(tag, client, leftmost)
        except Empty:
            with self.channel.conn_or_acquire(client) as connected, connected.pipeline() as pipe:
                untyped._remove_from_indices(tag, pipe)
                pipe.execute()


class _GuardedChannel(kombu.transport.redis.Channel):
    QoS = _GuardedQoS


class _GuardedTransport(kombu.transport.redis.Transport):
    """Redis as Celery uses it, but that what comes from a job queue goes through the gate."""

    Channel = _GuardedChannel

    def _deliver(self, message: object, queue: str) -> None:
        deliver: Any = super()._deliver
        try:
            # Remote control and events come by other ways than a list, and never bring a task.
            published = any(queue in channel.active_fanout_queues for channel in self.channels if channel)
            passed = _checked_control(message) if published else checked_envelope(message)
        except MessageError as error:
            log.error("dropped from %s: %s", queue, ascii(str(error)))
        else:
            deliver(passed, queue)


def _checked_control(message: object) -> dict[str, Any]:
    """Check a command or event of Celery's, and keep its known parts. Celery itself interprets its body."""
    try:
        control = _Control.model_validate(message)
        _Properties.model_validate(control.properties)
        decode_json(base64.b64decode(control.body, validate=True))
    except ValueError:
        raise MessageError("message refused: no remote control of Celery's") from None
    return control.model_dump(by_alias=True)


def _parse(text: str) -> Any:
    """Parse a text for the transport: a message off a queue, or a list of one that is put back and its address.

    Raises:
        Empty: if it is refused; for the transport this means that nothing has come.
    """
    try:
        if not text.startswith("["):
            return decode_json(text, ENVELOPE_BYTES)
        match decode_json(text, _RESTORED_BYTES):
            case [dict(), str(), str()] as restored:
                return restored
        raise MessageError("message refused: envelope: no object")
    except MessageError as error:
        log.error("dropped unread: %s", ascii(str(error)))
        raise Empty from None


def install() -> None:
    """Make this process receive through the gate only; call it before the application connects."""
    untyped: Any = kombu.transport.redis
    untyped.loads = _parse
    for name in ("redis", "rediss"):
        kombu.transport.TRANSPORT_ALIASES[name] = f"{__name__}:{_GuardedTransport.__name__}"
        kombu.transport._transport_cache.pop(name, None)  # or an earlier look-up would win
    # The pool's child decodes the body once more, by what is registered here.
    register: Any = serialization.register
    register("json", kombu_json.dumps, decode_json, "application/json", "utf-8")


def keep_only_task(app: Any) -> None:
    """Take Celery's built-in tasks (`celery.group`, `celery.chord`, ...) away, so that no message can call them.

    Args:
        app: the Celery application, with the farm's task registered.
    """
    app.finalize()
    for name in set(app.tasks) - {TASK_NAME}:
        app.tasks.unregister(name)
