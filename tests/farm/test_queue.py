"""What goes on the wire, and what is seen of it."""

import base64
import json
import re
import socket

import pytest
import redis

from farm.dataset import Dataset
from farm.errors import BrokerError
from farm.job import Job, JobMessage
from farm.queue.broker import broker_url, connect, masked
from farm.queue.celery import CeleryQueue
from farm.queue.memory import MemoryQueue
from farm.queue.port import JobQueue
from farm.queue.settings import HARD_LIMIT_S, QUEUE, SOFT_LIMIT_S, TASK_NAME, VISIBILITY_S, make_app
from tests.stand_in import SHA


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


def test_submitted_jobs_wait(queue: JobQueue, dataset: Dataset) -> None:
    """What was submitted is seen, more than a page of it too."""
    assert queue.submit(messages(dataset, 1100)) == 1100
    assert queue.length() == 1100
    assert queue.queued("cables", dataset.header.spec_sha256) == {f"far-{number:06d}" for number in range(1100)}


def test_other_datasets_are_not_seen(queue: JobQueue, dataset: Dataset) -> None:
    """A dataset sees its own jobs only."""
    queue.submit(messages(dataset, 1))
    assert queue.queued("wires", dataset.header.spec_sha256) == set()
    assert queue.queued("cables", "f" * 64) == set()


def test_empty_queue(queue: JobQueue) -> None:
    """Nothing waits in an empty queue."""
    assert queue.length() == 0
    assert queue.queued("cables", SHA) == set()


@pytest.mark.redis
def test_message_on_the_wire(redis_url: str, redis_client: "redis.Redis", dataset: Dataset) -> None:
    """A message is JSON, calls the task by name, and holds names and a fingerprint, no path."""
    CeleryQueue(make_app(redis_url), redis_client).submit(messages(dataset, 1))
    page = redis_client.lrange(QUEUE, 0, -1)
    assert isinstance(page, list)
    envelope = json.loads(page[0])
    assert envelope["content-type"] == "application/json"
    assert envelope["headers"]["task"] == TASK_NAME
    assert envelope["headers"]["id"] == f"cables:{dataset.header.spec_sha256[:12]}:far-000000"
    _, keywords, _ = json.loads(base64.b64decode(envelope["body"]))
    assert keywords == {"message": messages(dataset, 1)[0].encode()}
    assert dataset.storage.location not in page[0]


@pytest.mark.redis
def test_foreign_messages_are_passed_over(redis_url: str, redis_client: "redis.Redis") -> None:
    """Looking at the queue survives whatever lies in it."""
    redis_client.lpush(QUEUE, "no json", "[]", '{"headers": {}}', '{"headers": {"id": 3}}')
    assert CeleryQueue(make_app(redis_url), redis_client).queued("cables", SHA) == set()


def test_only_json_is_accepted() -> None:
    """No message can bring code: pickle and the like are refused."""
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
    """The option comes before the environment, and that before the default."""
    monkeypatch.setenv("FARM_BROKER_URL", "redis://there/0")
    assert broker_url("redis://here/0") == "redis://here/0"
    assert broker_url(None) == "redis://there/0"
    monkeypatch.delenv("FARM_BROKER_URL")
    assert broker_url(None) == "redis://localhost:6379/0"


@pytest.mark.parametrize("url", ["redis://127.0.0.1:1/0", "redis+socket:///nowhere/redis.sock", "redis://x:port/0"])
def test_no_redis_there(url: str) -> None:
    """A Redis that can't be reached is one line with its address."""
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
    """However odd the address, the refusal is the farm's own, in one line that keeps the secret."""
    with pytest.raises(BrokerError) as refused:
        connect(broker_url(url))
    assert not re.search("hu|sh", str(refused.value).replace("should", ""))
    assert "\n" not in str(refused.value)


def test_silent_redis() -> None:
    """A program that takes the connection and never answers is no Redis."""
    with socket.create_server(("127.0.0.1", 0)) as server, pytest.raises(BrokerError, match="no Redis at"):
        connect(f"redis://127.0.0.1:{server.getsockname()[1]}/0")


@pytest.mark.redis
def test_redis_that_goes_away(redis_url: str, dataset: Dataset) -> None:
    """A submission that loses its Redis ends as the farm's own error."""
    client = connect(redis_url)
    queue = CeleryQueue(make_app("redis://127.0.0.1:1/0"), client)
    with pytest.raises(BrokerError, match="submit again"):
        queue.submit(messages(dataset, 1))
