"""The access list for Redis: a farm works with it, and everything that no farm needs is refused."""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import redis
from redis.exceptions import NoPermissionError

from farm.dataset.dataset import Dataset
from farm.errors import BrokerError
from farm.local.workers import LocalWorkers
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle
from farm.run.queue.broker import connect
from farm.run.queue.settings import make_app
from farm.run.worker_settings import WorkerSettings
from tests.farm.run.queue.servers import debian_redis, free_port
from tests.farm.run.queue.servers import redis_server as run_redis

pytestmark = pytest.mark.redis

ACL = Path(__file__).parents[4] / "docker" / "redis-users.acl"
WORD = "hush"


@dataclass(frozen=True)
class Guarded:
    """A Redis with the access list: its place, and a client that may read its log of refusals."""

    place: str
    watcher: "redis.Redis"

    @property
    def url(self) -> str:
        """The farm's own address."""
        return f"redis://farm:{WORD}@{self.place}"


@pytest.fixture
def guarded(tmp_path: Path) -> Iterator[Guarded]:
    """The list as it is shipped, with a password put in and a user for the test added."""
    hashed = f"#{hashlib.sha256(WORD.encode()).hexdigest()}"
    lines = ACL.read_text().replace("user farm on resetpass", f"user farm on resetpass {hashed}")
    users = tmp_path / "users.acl"
    users.write_text(f"{lines}user watcher on >watch ~* &* +@all\n")
    port = free_port()
    with run_redis(debian_redis(), tmp_path / "redis", port, ["--port", str(port), "--aclfile", str(users)]):
        watcher = redis.Redis.from_url(f"redis://watcher:watch@127.0.0.1:{port}/0", decode_responses=True)
        yield Guarded(f"127.0.0.1:{port}/0", watcher)
        watcher.close()


def refusals(guarded: Guarded) -> list[tuple[str, str]]:
    """The refusals of Redis, with their reasons."""
    entries: list[dict[str, Any]] = guarded.watcher.acl_log()
    return [(entry["reason"], entry["object"]) for entry in entries]


def test_a_farm_works_under_the_list(
    guarded: Guarded, dataset: Dataset, worker_command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A worker, a job that is tried again and a look by remote control work without any refusal."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=once")
    client = connect(guarded.url)
    app = make_app(guarded.url)
    coordinator = Coordinator(dataset, open_handle(dataset, guarded.url, client), poll_s=0.1)
    coordinator.submit_missing()
    settings = WorkerSettings(store=str(tmp_path / "store"), name="local", logs=tmp_path / "logs")
    with LocalWorkers(1, settings, guarded.url, worker_command) as workers:
        assert coordinator.watch(supervise=workers.supervise).done == 4
        assert len(app.control.inspect(timeout=3).ping()) == 1
    assert refusals(guarded) == []


def test_a_queue_of_a_dataset_is_allowed(guarded: Guarded) -> None:
    """Queues named `farm`, or after a dataset's name and fingerprint, with Celery's priority, are allowed."""
    client = connect(guarded.url)
    for queue in ("farm", "farm\x06\x163", "farm.cables:0123456789ab", "farm.cables:0123456789ab\x06\x169"):
        assert client.lpush(queue, "{}") == 1
        assert client.llen(queue) == 1


@pytest.mark.parametrize(
    "command",
    [
        "FLUSHALL",
        "FLUSHDB",
        "KEYS *",
        "SCAN 0",
        "CONFIG GET requirepass",
        "CONFIG SET dir /tmp",
        "SAVE",
        "SHUTDOWN",
        "MONITOR",
        "CLIENT LIST",
        "REPLICAOF 127.0.0.1 1",
        "MODULE LIST",
        "ACL LIST",
        "SCRIPT FLUSH",
        "FUNCTION LIST",
        "EVAL return(1) 0",
        "INFO",
        "GET other",
        "SET other 1",
        "DEL other",
        "PUBLISH other 1",
    ],
)
def test_what_no_farm_needs_is_refused(guarded: Guarded, command: str) -> None:
    """Commands that affect the whole server, and keys and channels of others, are refused."""
    with pytest.raises(NoPermissionError):
        connect(guarded.url).execute_command(*command.split())  # type: ignore[no-untyped-call]  # untyped in redis-py


@pytest.mark.parametrize("user", ["", "farm:wrong@", "admin:admin@", "default:@"])
def test_nobody_else_gets_in(guarded: Guarded, user: str) -> None:
    """No user without a password, no wrong password and no administrator gets in."""
    with pytest.raises(BrokerError):
        connect(f"redis://{user}{guarded.place}")


def test_the_list_as_shipped_lets_nobody_in(tmp_path: Path) -> None:
    """The shipped list has no password, so that a forgotten one opens nothing."""
    port = free_port()
    with run_redis(debian_redis(), tmp_path / "redis", port, ["--port", str(port), "--aclfile", str(ACL)]):
        for user in ("", "farm:@", "farm:farm@", f"farm:{WORD}@"):
            with pytest.raises(BrokerError):
                connect(f"redis://{user}127.0.0.1:{port}/0")
