"""Messages that no worker can understand."""

import base64
import json
from collections.abc import Callable
from typing import Any

Envelope = dict[str, Any]


def _with_body(content: object) -> Callable[[Envelope], None]:
    def change(envelope: Envelope) -> None:
        envelope["body"] = base64.b64encode(json.dumps(content).encode()).decode()

    return change


def _no_base64(envelope: Envelope) -> None:
    envelope["body"] = "%%%"


def _another_task(envelope: Envelope) -> None:
    envelope["headers"]["task"] = "somebody.elses.task"


def _no_headers(envelope: Envelope) -> None:
    envelope["headers"] = {}


def _pickle(envelope: Envelope) -> None:
    # These bytes aren't a pickle: a worker that tried to unpickle them would fail, and one that refuses them passes.
    envelope["content-type"] = "application/x-python-serialize"


_EMBED: Envelope = {"callbacks": None, "errbacks": None, "chain": None, "chord": None}

_SPOILT: tuple[Callable[[Envelope], None], ...] = (
    _with_body("no list"),
    _with_body([[], {"message": {"version": 99}}, _EMBED]),
    _with_body([[], {"message": "far-000000"}, _EMBED]),
    _with_body([[], {"other": 1}, _EMBED]),
    _with_body([[], {"message": None}, _EMBED]),
    _no_base64,
    _another_task,
    _no_headers,
    _pickle,
)

_GARBAGE = ("", "no JSON", "{}", "[1, 2, 3]", "null", "17", '{"body": 1, "properties": {}}', "\x00\xff" * 1000)


def poisons(message: str) -> list[str]:
    """Every kind of poison; those that look most like messages are made from a real one."""
    found = list(_GARBAGE)
    for spoil in _SPOILT:
        envelope = json.loads(message)
        spoil(envelope)
        found.append(json.dumps(envelope))
    return found
