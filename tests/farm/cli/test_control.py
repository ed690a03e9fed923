"""`farm pause`, `resume` and `cancel`."""

import pytest
import redis

from farm.dataset.dataset import Dataset
from farm.errors import ConflictError, DestinationError
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle
from farm.run.progress import RunHandle
from farm.run.registry.port import Priority, Run, RunState
from farm.run.registry.redis import RedisRegistry
from tests.farm.cli.result import Farm, assert_refused

pytestmark = pytest.mark.redis


@pytest.fixture
def submitted(dataset: Dataset, redis_url: str, redis_client: "redis.Redis") -> RunHandle:
    """A run of four waiting images."""
    handle = open_handle(dataset, redis_url, redis_client)
    Coordinator(dataset, handle).submit_missing()
    return handle


def on_the_board(handle: RunHandle) -> Run:
    """The run's notice in the registry."""
    return handle.registry.runs()[handle.run.key]


def test_pause_and_resume(farm: Farm, submitted: RunHandle, dataset: Dataset, redis_url: str) -> None:
    """A paused run keeps its queue and says how to resume; a resumed one is active again."""
    place = [dataset.storage.location, "--broker", redis_url]
    assert "4 images wait; farm resume" in farm("pause", *place).stdout
    assert on_the_board(submitted).state is RunState.PAUSED
    assert "4 images wait" in farm("resume", *place).stdout
    assert on_the_board(submitted).state is RunState.ACTIVE
    assert submitted.queue.length(submitted.run) == 4


def test_resume_with_a_priority(farm: Farm, submitted: RunHandle, dataset: Dataset, redis_url: str) -> None:
    """Resuming with another priority affects later messages alone; pausing keeps the priority."""
    place = [dataset.storage.location, "--broker", redis_url]
    result = farm("resume", *place, "--priority", "high")
    assert "the 4 images that wait keep their priority" in result.stderr
    farm("pause", *place)
    assert on_the_board(submitted) == submitted.run.model_copy(
        update={"priority": Priority.HIGH, "state": RunState.PAUSED}
    )


def test_cancel(farm: Farm, submitted: RunHandle, dataset: Dataset, redis_url: str) -> None:
    """A cancelled run has an empty queue, and a watcher is told so."""
    result = farm("cancel", dataset.storage.location, "--broker", redis_url)
    assert "4 images were waiting" in result.stdout
    assert on_the_board(submitted).state is RunState.CANCELLED
    assert submitted.queue.length(submitted.run) == 0


@pytest.mark.parametrize("command", ["pause", "resume", "cancel"])
def test_no_run(farm: Farm, dataset: Dataset, redis_url: str, redis_client: "redis.Redis", command: str) -> None:
    """Without a submission there is nothing to control, and no run is registered."""
    result = farm(command, dataset.storage.location, "--broker", redis_url)
    assert_refused(result, ConflictError.exit_code, "it was not submitted")
    assert RedisRegistry(redis_client).runs() == {}


@pytest.mark.parametrize("command", ["pause", "resume", "cancel", "repair", "retry"])
def test_no_dataset(farm: Farm, redis_url: str, command: str) -> None:
    """Without a dataset the command says so."""
    assert_refused(farm(command, "data", "--broker", redis_url), DestinationError.exit_code, "no dataset here")
