"""Hostile messages in the queue of a real worker: each is dropped with one line, and the next good one is worked on."""

import base64
import json
import pickle
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import pytest
import redis

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.local.redis_server import private_redis
from farm.local.workers import LocalWorkers
from farm.run.queue.broker import connect
from farm.run.queue.settings import QUEUE, TASK_NAME, VISIBILITY_S, make_app
from farm.run.worker_settings import WorkerSettings
from farm.spec.job import Job
from tests.stand_in import stand_in_header

pytestmark = pytest.mark.redis

PATIENCE_S = 60.0
JOBS = 500
Message = dict[str, Any]


@dataclass
class Bench:
    """A worker behind the gate, and what reaches it."""

    client: "redis.Redis"
    app: Any
    dataset: Dataset
    log: Path
    used: int = 0

    def _next_job(self) -> Job:
        self.used += 1
        return Job.from_id(f"far-{self.used:06d}")

    def good(self) -> Message:
        """The message of a job that wasn't asked for yet, before it is put into any queue."""
        message = self.dataset.message(self._next_job())
        self.app.send_task(TASK_NAME, kwargs={"message": message.encode()}, task_id=message.task_id, queue="spare")
        return cast(Message, json.loads(str(self.client.lpop("spare"))))

    def goes_on(self) -> list[str]:
        """Wait until the next good job is done; returns the log's lines on dropped messages so far."""
        job = self._next_job()
        message = self.dataset.message(job)
        self.app.send_task(TASK_NAME, kwargs={"message": message.encode()}, task_id=message.task_id, queue=QUEUE)
        give_up_s = time.monotonic() + PATIENCE_S
        while not is_done(self.dataset, job):
            assert time.monotonic() < give_up_s, self.log.read_text()[-3000:]
            time.sleep(0.02)
        text = self.log.read_text()
        assert "Traceback" not in text
        return [line for line in text.splitlines() if "dropped" in line]


@pytest.fixture(scope="module")
def stale() -> list[str]:
    """Entries for the hash of unacknowledged messages, such as a worker that died long before leaves."""
    return ["[" * 50_000, "[1, 2", '["x", "", "farm"]', "[[], {}, 3]", "no json"]


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory, stale: list[str]) -> Iterator[Bench]:
    """One worker for all tests here; if a message ends it, later tests fail. Poisoned entries wait to be put back."""
    folder = tmp_path_factory.mktemp("gate")
    dataset = create_dataset(Destination(str(folder / "store"), "cables"), stand_in_header(far=JOBS))
    with private_redis() as url:
        client = connect(url)
        for number, entry in enumerate(stale):
            client.hset("unacked", f"stale-{number}", entry)
            client.zadd("unacked_index", {f"stale-{number}": time.time() - 2 * VISIBILITY_S})
        settings = WorkerSettings(store=str(folder / "store"), name="local", logs=folder / "logs")
        command = [sys.executable, "-P", str(Path(__file__).parents[3] / "stand_in.py")]
        with LocalWorkers(1, settings, url, command) as workers:
            yield Bench(client, make_app(url), dataset, workers.log_of("local-1"))


def with_body(message: Message, body: bytes) -> Message:
    """The message with another body."""
    return message | {"body": base64.b64encode(body).decode()}


def with_header(name: str, value: object) -> Callable[[Message], str]:
    """A change that sets one header."""
    return lambda message: json.dumps(message | {"headers": message["headers"] | {name: value}})


def with_call(change: Callable[[list[Any]], object]) -> Callable[[Message], str]:
    """A change of the call: arguments, named arguments, and the tasks to call afterwards."""

    def changed(message: Message) -> str:
        call = json.loads(base64.b64decode(message["body"]))
        change(call)
        return json.dumps(with_body(message, json.dumps(call).encode()))

    return changed


HOSTILE: dict[str, tuple[Callable[[Message], str | bytes], str]] = {
    "10 MB": (lambda message: json.dumps(with_body(message, b"x" * 10_000_000)), "bytes are more than"),
    "10 MB of nothing": (lambda _: "x" * 10_000_000, "bytes are more than"),
    "body over the limit": (lambda message: json.dumps(with_body(message, b"x" * 70_000)), "bytes are more than 65536"),
    "deep envelope": (lambda _: '{"a":' * 20_000, "nested deeper"),
    "deep list": (lambda _: "[" * 60_000 + "]" * 60_000, "dropped"),
    "deep body": (lambda message: json.dumps(with_body(message, b"[" * 30_000 + b"]" * 30_000)), "nested deeper"),
    "garbage": (lambda _: b"\x80\xff\x00garbage", "no JSON"),
    "empty": (lambda _: b"", "no JSON"),
    "garbage body": (lambda message: json.dumps(with_body(message, b"\x80\xff\x00")), "no JSON"),
    "body not in base64": (lambda message: json.dumps(message | {"body": "???"}), "base64"),
    "number": (lambda _: "3", "envelope"),
    "short list": (lambda _: "[1]", "envelope"),
    "null": (lambda _: "null", "envelope"),
    "no properties": (lambda message: json.dumps({**message, "properties": {}}), "delivery_tag"),
    "no headers": (lambda message: json.dumps({**message, "headers": None}), "headers"),
    "pickle": (
        lambda message: json.dumps(
            with_body(message, pickle.dumps({"message": 1})) | {"content-type": "application/x-python-serialize"}
        ),
        "content-type",
    ),
    "yaml": (lambda message: json.dumps(message | {"content-type": "application/x-yaml"}), "content-type"),
    "plain bytes": (lambda message: json.dumps(message | {"content-type": "application/data"}), "content-type"),
    "unknown task": (with_header("task", "os.system"), "headers.task"),
    "built-in group": (with_header("task", "celery.group"), "headers.task"),
    "line break in the id": (with_header("id", "a\nCRITICAL forged line"), "headers.id"),
    "time that is none": (with_header("eta", "soon"), "headers.eta"),
    "number as time": (with_header("eta", 5), "headers.eta"),
    "call afterwards": (with_call(lambda call: call[2].update(chain=[{"task": "farm.render_image"}])), "plain call"),
    "call on failure": (with_call(lambda call: call[2].update(errbacks=[{"task": "x"}])), "plain call"),
    "positional arguments": (with_call(lambda call: call[0].append(1)), "plain call"),
    "more arguments": (with_call(lambda call: call[1].update(path="/etc/passwd")), "plain call"),
    "no argument": (with_call(lambda call: call[1].clear()), "plain call"),
    "body of another protocol": (lambda message: json.dumps(with_body(message, b'{"task": "x", "id": "y"}')), "plain"),
    "key twice": (lambda message: json.dumps(message)[:-1] + ', "headers": {}}', "twice"),
    "number that is none": (lambda message: json.dumps(message)[:-1] + ', "x": NaN}', "NaN"),
}


@pytest.mark.parametrize("kind", HOSTILE)
def test_a_hostile_message_is_dropped(bench: Bench, kind: str) -> None:
    """A hostile message is reported in one line and not kept, and the worker continues."""
    make, reason = HOSTILE[kind]
    hostile = make(bench.good())
    before = len(bench.goes_on())
    bench.client.lpush(QUEUE, hostile)
    told = bench.goes_on()[before:]
    assert len(told) == 1
    assert reason in told[0]
    assert len(told[0]) < 500


def test_nothing_of_them_is_kept(bench: Bench) -> None:
    """No message waits to be delivered again, not even those that were poisoned from the start."""
    bench.goes_on()
    give_up_s = time.monotonic() + PATIENCE_S
    while bench.client.hlen("unacked") or bench.client.llen(QUEUE):
        assert time.monotonic() < give_up_s, bench.client.hgetall("unacked")
        time.sleep(0.05)


@pytest.mark.parametrize("name", ["timelimit", "expires", "stamps", "shadow", "compression", "group"])
def test_other_headers_have_no_effect(bench: Bench, name: str) -> None:
    """A message can't set its own time limit or name in the log, as the farm discards headers that it doesn't use."""
    message = bench.good()
    bench.client.lpush(QUEUE, with_header(name, ["bzip2", 1])(message))
    bench.goes_on()
    assert is_done(bench.dataset, Job.from_id(message["headers"]["id"].rpartition(":")[2]))


@pytest.mark.parametrize("payload", [b"\x80", b"{}", b"[1]", b'{"properties": {}}', b'{"a":' * 50_000])
def test_garbage_for_remote_control_is_passed_over(bench: Bench, payload: bytes) -> None:
    """Garbage on Celery's channel of commands doesn't end the worker."""
    bench.client.publish("/0.celery.pidbox", payload)
    bench.goes_on()


def test_only_the_farms_task_can_be_called(bench: Bench) -> None:
    """The worker tells Celery that it knows one task, and none of the built-in ones."""
    answers = bench.app.control.inspect(timeout=5).registered(None)
    assert [set(names) for names in answers.values()] == [{TASK_NAME}]
