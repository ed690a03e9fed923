"""`farm submit`."""

from pathlib import Path

import pytest
import redis

from farm.errors import BrokerError, ConflictError
from farm.run.registry.port import Priority, RunState
from farm.run.registry.redis import RedisRegistry
from tests.farm.cli.result import Farm, assert_refused
from tests.farm.run.queue.servers import refusing_redis


@pytest.mark.redis
def test_submit_queues_once(farm: Farm, redis_url: str, redis_client: object) -> None:
    """A submission is queued; a repeated one adds nothing, and another description is refused."""
    del redis_client  # this fixture empties the queue
    options = ["--out", "data", "--broker", redis_url]
    first = farm("submit", "--images", "12", *options)
    assert first.stdout.startswith("12 of 12 images queued"), first.stderr
    again = farm("submit", "--images", "12", *options)
    assert again.stdout.startswith("0 of 12 images queued")
    other = farm("submit", "--images", "12", "--seed", "5", *options)
    assert_refused(other, ConflictError.exit_code, "spec.seed is 0, asked 5", "another --out")


@pytest.mark.redis
def test_submit_again_goes_on(farm: Farm, redis_url: str, redis_client: "redis.Redis") -> None:
    """A cancelled run continues when it is submitted again, with the new priority."""
    options = ["--images", "12", "--out", "data", "--broker", redis_url]
    farm("submit", *options)
    assert farm("cancel", "data", "--broker", redis_url).returncode == 0
    again = farm("submit", *options, "--priority", "high")
    assert again.stdout.startswith("12 of 12 images queued"), again.stderr
    (run,) = RedisRegistry(redis_client).runs().values()
    assert (run.state, run.priority) == (RunState.ACTIVE, Priority.HIGH)


@pytest.mark.redis
@pytest.mark.parametrize(("kind", "words"), [("replica", "is a replica"), ("full", "is full")])
def test_submit_to_a_redis_that_refuses(farm: Farm, tmp_path: Path, kind: str, words: str) -> None:
    """A submission to a Redis that takes no jobs leaves no dataset without them."""
    with refusing_redis(kind, tmp_path / "redis") as url:
        result = farm("submit", "--images", "12", "--out", "data", "--broker", url)
    assert_refused(result, BrokerError.exit_code, words)
    assert not (tmp_path / "data").exists()


def test_submit_takes_over_from_another_release(farm: Farm, redis_url: str, redis_client: "redis.Redis") -> None:
    """A run of another release is left alone by all other commands; a submission replaces it, and says so."""
    options = ["--out", "data", "--broker", redis_url]
    farm("submit", "--images", "12", *options)
    registry = RedisRegistry(redis_client)
    (run,) = registry.runs().values()
    registry.replace(run.model_copy(update={"release": "9.9.9"}))
    assert_refused(farm("repair", "data", "--broker", redis_url), ConflictError.exit_code, "release 9.9.9")
    told = farm("submit", "--images", "12", *options)
    assert "its run of release 9.9.9 is replaced" in told.stderr
    assert told.stdout.startswith("12 of 12 images queued"), told.stderr
    assert registry.runs() == {run.key: run}
