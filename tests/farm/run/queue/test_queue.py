"""The messages in Redis, and what is seen of them."""

import base64
import json
import re
import socket
import subprocess
from collections.abc import Iterable
from pathlib import Path

import pytest
import redis
from redis.backoff import NoBackoff
from redis.retry import Retry

from farm.dataset.dataset import Dataset
from farm.errors import BrokerError
from farm.local.redis_server import find_redis_server
from farm.run.handle import run_of
from farm.run.queue.broker import broker_url, connect, masked, wait_for
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.port import JobQueue
from farm.run.queue.settings import SOFT_LIMIT_S, TASK_NAME, VISIBILITY_S, make_app, queue_name
from farm.run.registry.port import Priority, Run
from farm.run.worker_settings import HARD_LIMIT_S
from farm.spec.job import Job, JobMessage
from tests.doubles.queue import MemoryQueue


@pytest.fixture(params=["memory", pytest.param("celery", marks=pytest.mark.redis)])
def queue(request: pytest.FixtureRequest) -> JobQueue:
    """An empty queue."""
    if request.param == "memory":
        return MemoryQueue()
    url, client = request.getfixturevalue("redis_url"), request.getfixturevalue("redis_client")
    return CeleryQueue(make_app(url), client)


def messages(dataset: Dataset, count: int) -> list[JobMessage]:
    """Messages for jobs of one category."""
    return [dataset.message(Job.from_id(f"far-{number:06d}")) for number in range(count)]


def ids(jobs: Iterable[Job]) -> list[str]:
    """The jobs' ids, in order."""
    return sorted(job.id for job in jobs)


@pytest.fixture
def run(dataset: Dataset) -> Run:
    """The dataset's run."""
    return run_of(dataset)


def test_submitted_jobs_wait(queue: JobQueue, run: Run, dataset: Dataset) -> None:
    """Submitted jobs are seen, also more than a page of them."""
    assert queue.submit(run, messages(dataset, 1100)) == 1100
    assert queue.length(run) == 1100
    assert ids(queue.queued(run)) == [f"far-{number:06d}" for number in range(1100)]


def test_other_runs_are_apart(queue: JobQueue, run: Run, dataset: Dataset) -> None:
    """A run sees and empties its own queue only."""
    others = (run.model_copy(update={"dataset": "wires"}), run.model_copy(update={"spec_sha256": "f" * 64}))
    queue.submit(run, messages(dataset, 1))
    for other in others:
        assert queue.length(other) == queue.clear(other) == 0
        assert ids(queue.queued(other)) == []
    assert queue.length(run) == 1


def test_empty_queue(queue: JobQueue, run: Run) -> None:
    """An empty queue has no waiting jobs."""
    assert queue.length(run) == 0
    assert ids(queue.queued(run)) == []


def test_cleared_queue(queue: JobQueue, run: Run, dataset: Dataset) -> None:
    """A queue is emptied whole, whatever the messages' priorities, and their number is returned."""
    for number, priority in enumerate(Priority):
        job = dataset.message(Job.from_id(f"far-{number:06d}"))
        queue.submit(run.model_copy(update={"priority": priority}), [job])
    assert queue.clear(run) == queue.clear(run) + 3 == 3
    assert queue.length(run) == 0


def test_priorities_are_seen_alike(queue: JobQueue, run: Run, dataset: Dataset) -> None:
    """A run whose priority has changed still sees the messages with the old one."""
    queue.submit(run.model_copy(update={"priority": Priority.HIGH}), messages(dataset, 1))
    assert queue.length(run) == 1
    assert ids(queue.queued(run)) == ["far-000000"]


@pytest.mark.redis
@pytest.mark.parametrize("priority", Priority)
def test_message_on_the_wire(
    redis_url: str, redis_client: "redis.Redis", run: Run, dataset: Dataset, priority: Priority
) -> None:
    """A message is JSON, calls the task by name, and holds names and a fingerprint but no path."""
    run = run.model_copy(update={"priority": priority})
    CeleryQueue(make_app(redis_url), redis_client).submit(run, messages(dataset, 1))
    name = queue_name(run.key) + (f"\x06\x16{priority.step}" if priority.step else "")
    page = redis_client.lrange(name, 0, -1)
    assert isinstance(page, list)
    envelope = json.loads(page[0])
    assert envelope["content-type"] == "application/json"
    assert envelope["headers"]["task"] == TASK_NAME
    assert envelope["headers"]["id"] == f"cables:{dataset.identity[:12]}:far-000000"
    _, keywords, _ = json.loads(base64.b64decode(envelope["body"]))
    assert keywords == {"message": messages(dataset, 1)[0].encode()}
    assert dataset.storage.location not in page[0]


@pytest.mark.redis
def test_foreign_messages_are_passed_over(redis_url: str, redis_client: "redis.Redis", run: Run) -> None:
    """Foreign messages in the queue are ignored."""
    foreign = ("no json", "[]", '{"headers": {}}', '{"headers": {"id": 3}}', '{"headers": {"id": "other:far-000001"}}')
    redis_client.lpush(queue_name(run.key), *foreign, "[" * 100_000)
    assert ids(CeleryQueue(make_app(redis_url), redis_client).queued(run)) == []


def test_only_json_is_accepted() -> None:
    """Pickle and the like are refused, so no message can bring code."""
    assert list(make_app("memory://").conf.accept_content) == ["json"]


def test_limits_are_in_order() -> None:
    """A message is not given to another worker while its job may still run."""
    assert SOFT_LIMIT_S < HARD_LIMIT_S < VISIBILITY_S / 2


@pytest.mark.parametrize(
    ("url", "shown"),
    [
        ("redis://:hush@host:1/0", "redis://***@host:1/0"),
        ("redis://me:hush@host/0", "redis://***@host/0"),
        ("redis://:pa/ss@host/0", "redis://***@host/0"),
        ("redis://:hu#sh@host", "redis://***@host"),
        ("redis://:hu@sh@host", "redis://***@host"),
        ("redis://host/0?password=hush", "redis://host/0"),
        ("redis://:s@[bad/0", "redis://***@[bad/0"),
        ("hush", "(no address)"),
        ("redis://host/0", "redis://host/0"),
        ("redis+socket:///tmp/redis.sock", "redis+socket:///tmp/redis.sock"),
    ],
)
def test_passwords_are_masked(url: str, shown: str) -> None:
    """An address is shown without its password."""
    assert masked(url) == shown


def test_address_given_wins(monkeypatch: pytest.MonkeyPatch) -> None:
    """The option takes precedence over the environment, and the environment over the default."""
    monkeypatch.setenv("FARM_BROKER_URL", "redis://there/0")
    assert broker_url("redis://here/0") == "redis://here/0"
    assert broker_url(None) == "redis://there/0"
    monkeypatch.delenv("FARM_BROKER_URL")
    assert broker_url(None) == "redis://localhost:6379/0"


@pytest.mark.parametrize("url", ["redis://127.0.0.1:1/0", "redis+socket:///nowhere/redis.sock", "redis://x:port/0"])
def test_no_redis_there(url: str) -> None:
    """A Redis that can't be reached gives one line with its address."""
    with pytest.raises(BrokerError, match="no Redis at") as refused:
        connect(url)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "url",
    [
        "redis://:hu/sh@127.0.0.1:1/0",
        "redis://:hu#sh@127.0.0.1:1",
        "redis://:hu?sh@127.0.0.1:1",
        "redis://127.0.0.1:1/0?password=hush",
        "redis://127.0.0.1:1/0?password=hush&socket_timeout=hush",
        "redis://:hush@[bad/0",
        "hush",
    ],
)
def test_no_part_of_a_password_is_told(url: str) -> None:
    """However odd the address, the refusal is the farm's own, in one line without the secret."""
    with pytest.raises(BrokerError) as refused:
        connect(broker_url(url))
    assert not re.search("hu|sh", str(refused.value).replace("should", ""))
    assert "\n" not in str(refused.value)


def test_silent_redis() -> None:
    """A program that accepts the connection and never answers isn't a Redis."""
    with socket.create_server(("127.0.0.1", 0)) as server, pytest.raises(BrokerError, match="no Redis at"):
        connect(f"redis://127.0.0.1:{server.getsockname()[1]}/0")


@pytest.mark.redis
def test_redis_that_goes_away(redis_url: str, run: Run, dataset: Dataset) -> None:
    """A submission that loses its Redis ends as the farm's own error."""
    client = connect(redis_url)
    queue = CeleryQueue(make_app("redis://127.0.0.1:1/0"), client)
    with pytest.raises(BrokerError, match="submit again"):
        queue.submit(run, messages(dataset, 1))


@pytest.mark.parametrize("ask", ["length", "queued", "clear"])
def test_look_at_a_redis_that_is_away(run: Run, ask: str) -> None:
    """A look that finds no Redis ends as the farm's own error."""
    queue = CeleryQueue(
        make_app("redis://127.0.0.1:1/0"), redis.Redis(port=1, retry=Retry(NoBackoff(), 0), decode_responses=True)
    )
    with pytest.raises(BrokerError):
        ids(getattr(queue, ask)(run))


@pytest.mark.redis
def test_waits_for_a_redis_that_comes_later(tmp_path: Path) -> None:
    """A worker that is started before its Redis finds it once it starts."""
    socket = tmp_path / "late.sock"
    server = find_redis_server()
    command = f"sleep 0.5; exec {server} --port 0 --unixsocket {socket} --save ''"
    process = subprocess.Popen(["/bin/sh", "-c", command], stdout=subprocess.DEVNULL)
    try:
        wait_for(f"redis+socket://{socket}", patience_s=30.0)
    finally:
        process.terminate()
        process.wait()


def test_does_not_wait_for_ever() -> None:
    """A worker reports a Redis that never starts."""
    with pytest.raises(BrokerError, match="no Redis at"):
        wait_for("redis://127.0.0.1:1/0", patience_s=0.1)
