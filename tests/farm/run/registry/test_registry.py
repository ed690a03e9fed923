"""One suite over the run registry in memory and the one in Redis."""

import json
from pathlib import Path

import pytest
import redis
from redis.backoff import NoBackoff
from redis.retry import Retry

from farm.errors import BrokerError, ConflictError
from farm.run.registry.port import SEEN_S, Priority, Run, RunRegistry, RunState, WorkerReport, WorkerState
from farm.run.registry.redis import RedisRegistry
from tests.doubles.registry import MemoryRegistry

RUN = Run(dataset="cables", spec_sha256="0" * 64)
PAUSED = RUN.model_copy(update={"state": RunState.PAUSED})
GOLDEN = Path(__file__).parents[1] / "golden" / "0.1.0"
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


RESTING = RUN.encode().replace("active", "resting")
UNREADABLE = ["", "no json", "{}", '{"dataset": "../..", "spec_sha256": "0"}', RESTING]


@pytest.mark.redis
@pytest.mark.parametrize("text", UNREADABLE)
def test_unreadable_notices_are_left_alone(redis_client: "redis.Redis", text: str) -> None:
    """An unreadable notice of another release hides no other one, and is replaced by a person's submission alone."""
    registry = RedisRegistry(redis_client)
    registry.report(IDLE)
    redis_client.hset("farm:runs", RUN.key, text)
    redis_client.hset("farm:workers", "b@host", text)
    redis_client.zadd("farm:workers:seen", {"b@host": 2**33})
    assert registry.runs() == {}
    assert registry.workers() == (IDLE,)
    for touch in (lambda: registry.register(RUN), lambda: registry.change(RUN.key, RunState.ACTIVE)):
        with pytest.raises(ConflictError, match="another release"):
            touch()
    assert redis_client.hget("farm:runs", RUN.key) == text
    registry.replace(RUN)
    assert registry.runs() == {RUN.key: RUN}


@pytest.mark.redis
def test_keys_of_a_later_release_stay(redis_client: "redis.Redis") -> None:
    """A notice with keys that are unknown here is read, respected, and loses none of them when it is changed."""
    registry = RedisRegistry(redis_client)
    later = json.loads(PAUSED.encode()) | {"tint": [], "shade": {"a": 1}}
    redis_client.hset("farm:runs", RUN.key, json.dumps(later))
    assert registry.register(RUN) == PAUSED
    assert registry.change(RUN.key, RunState.ACTIVE, Priority.HIGH)
    assert json.loads(str(redis_client.hget("farm:runs", RUN.key))) == later | {"state": "active", "priority": "high"}
    assert registry.runs() == {RUN.key: RUN.model_copy(update={"priority": Priority.HIGH})}


def test_changed_run(registry: RunRegistry) -> None:
    """State and priority of a run that is up are changed; of another there is nothing to change."""
    registry.register(RUN)
    assert registry.change(RUN.key, RunState.PAUSED)
    assert registry.runs() == {RUN.key: PAUSED}
    assert not registry.change("wires:000000000000", RunState.PAUSED)


@pytest.mark.redis
def test_entries_of_the_first_release(redis_client: "redis.Redis") -> None:
    """What release 0.1.0 registers is read, a run's entry is written back as it was, and only its state changes."""
    registry = RedisRegistry(redis_client)
    run, worker = ((GOLDEN / f"{name}.json").read_text().strip() for name in ("run-paused", "worker"))
    key = f"cables:{json.loads(run)['spec_sha256'][:12]}"
    redis_client.hset("farm:runs", key, run)
    redis_client.hset("farm:workers", "worker-1@host", worker)
    redis_client.zadd("farm:workers:seen", {"worker-1@host": 2**33})
    found = registry.runs()[key]
    assert (found.state, found.priority, found.place, found.release) == (RunState.PAUSED, Priority.HIGH, "", "")
    assert found.encode() == run
    (report,) = registry.workers()
    assert (report.state, report.jobs, report.release, report.serves) == (WorkerState.WORKING, ("far-000001",), "", ())
    assert registry.change(key, RunState.ACTIVE)
    assert json.loads(str(redis_client.hget("farm:runs", key))) == json.loads(run) | {"state": "active"}


def test_a_place_hides_a_run_from_the_first_release() -> None:
    """The key and the entry of a run with a place are none that release 0.1.0 takes: it forbids unknown keys."""
    run = RUN.model_copy(update={"place": "0123456789abcdef", "release": "9.0.0"})
    assert run.key != RUN.key == run.older_key
    assert json.loads(run.encode()).keys() - json.loads((GOLDEN / "run-paused.json").read_text()).keys()


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
