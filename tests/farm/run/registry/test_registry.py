"""One suite over the run registry in memory and the one in Redis."""

import pytest
import redis
from redis.backoff import NoBackoff
from redis.retry import Retry

from farm.errors import BrokerError
from farm.run.registry.port import SEEN_S, Priority, Run, RunRegistry, RunState, WorkerReport, WorkerState
from farm.run.registry.redis import RedisRegistry
from tests.doubles.registry import MemoryRegistry

RUN = Run(dataset="cables", spec_sha256="0" * 64)
IDLE = WorkerReport(name="a@host", state=WorkerState.IDLE)


@pytest.fixture(params=["memory", pytest.param("redis", marks=pytest.mark.redis)])
def registry(request: pytest.FixtureRequest) -> RunRegistry:
    """An empty registry."""
    if request.param == "memory":
        return MemoryRegistry()
    return RedisRegistry(request.getfixturevalue("redis_client"))


def test_empty_board(registry: RunRegistry) -> None:
    """An empty registry has no run and no worker."""
    assert registry.runs() == {}
    assert registry.workers() == ()


def test_registered_run_is_up(registry: RunRegistry) -> None:
    """A registered run is found by its key, with all of its fields."""
    run = RUN.model_copy(update={"priority": Priority.HIGH, "state": RunState.PAUSED})
    assert registry.register(run) == run
    assert registry.runs() == {run.key: run}


def test_registering_again_changes_nothing(registry: RunRegistry) -> None:
    """A run that was paused stays so when it is registered again."""
    paused = RUN.model_copy(update={"state": RunState.PAUSED})
    registry.register(paused)
    assert registry.register(RUN) == paused
    assert registry.runs() == {RUN.key: paused}


def test_replaced_run(registry: RunRegistry) -> None:
    """A notice replaces the earlier one, or is the first."""
    registry.replace(RUN)
    cancelled = RUN.model_copy(update={"state": RunState.CANCELLED})
    registry.replace(cancelled)
    assert registry.runs() == {RUN.key: cancelled}


def test_runs_of_one_name_are_apart(registry: RunRegistry) -> None:
    """Two descriptions under one name are two runs, and one of them can be removed."""
    other = RUN.model_copy(update={"spec_sha256": "1" * 64})
    registry.register(RUN)
    registry.register(other)
    registry.remove(RUN.key)
    registry.remove(RUN.key)
    assert registry.runs() == {other.key: other}


def test_newest_report_counts(registry: RunRegistry) -> None:
    """The last report of each worker is listed, in the order of their names."""
    working = WorkerReport(
        name="a@host", state=WorkerState.WORKING, reason="none", jobs=("far-000001",), done=3, rss_bytes=2**31
    )
    other = WorkerReport(name="B@host", state=WorkerState.HELD, reason="disk full")
    for report in (IDLE, other, working):
        registry.report(report)
    assert registry.workers() == (other, working)


def test_worker_that_signs_off(registry: RunRegistry) -> None:
    """A worker that has ended isn't listed, and signing off twice is no error."""
    registry.report(IDLE)
    registry.sign_off(IDLE.name)
    registry.sign_off(IDLE.name)
    assert registry.workers() == ()


@pytest.mark.redis
def test_silent_worker_is_gone(redis_client: "redis.Redis") -> None:
    """A worker that hasn't reported for long isn't listed, and the next report of another one removes it."""
    registry = RedisRegistry(redis_client)
    registry.report(IDLE)
    redis_client.zincrby("farm:workers:seen", -SEEN_S - 1, IDLE.name)
    assert registry.workers() == ()
    other = IDLE.model_copy(update={"name": "b@host"})
    registry.report(other)
    assert registry.workers() == (other,)
    assert redis_client.hkeys("farm:workers") == [other.name]


@pytest.mark.redis
@pytest.mark.parametrize("text", ["", "no json", "{}", '{"dataset": "../..", "spec_sha256": "0"}'])
def test_unreadable_notices_are_passed_over(redis_client: "redis.Redis", text: str) -> None:
    """An unreadable notice of another version or program hides no other one, and is replaced when its run registers."""
    registry = RedisRegistry(redis_client)
    registry.report(IDLE)
    redis_client.hset("farm:runs", RUN.key, text)
    redis_client.hset("farm:workers", "b@host", text)
    redis_client.zadd("farm:workers:seen", {"b@host": 2**33})
    assert registry.runs() == {}
    assert registry.workers() == (IDLE,)
    assert registry.register(RUN) == RUN
    assert registry.runs() == {RUN.key: RUN}


@pytest.mark.redis
def test_notice_under_another_key_is_passed_over(redis_client: "redis.Redis") -> None:
    """A notice whose key isn't its run's is ignored."""
    redis_client.hset("farm:runs", "wires:000000000000", RUN.model_dump_json())
    assert RedisRegistry(redis_client).runs() == {}


@pytest.mark.redis
def test_notices_lapse(redis_client: "redis.Redis") -> None:
    """Notices that nobody writes expire in the end."""
    registry = RedisRegistry(redis_client)
    old = RUN.model_copy(update={"dataset": "old"})
    registry.register(old)
    redis_client.zadd("farm:runs:seen", {old.key: 1.0})
    registry.register(RUN)
    assert list(registry.runs()) == [RUN.key]


def test_redis_that_is_away() -> None:
    """A registry that can't be reached raises the farm's own error."""
    registry = RedisRegistry(redis.Redis(port=1, retry=Retry(NoBackoff(), 0), decode_responses=True))
    for ask in (registry.runs, registry.workers, lambda: registry.register(RUN), lambda: registry.report(IDLE)):
        with pytest.raises(BrokerError):
            ask()


def test_priorities_are_in_order() -> None:
    """High comes before normal, and normal before low."""
    assert Priority.HIGH.step < Priority.NORMAL.step < Priority.LOW.step
