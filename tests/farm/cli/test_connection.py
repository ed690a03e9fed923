"""An unusable Redis ends a command before anything is written."""

from pathlib import Path

import pytest

from farm.dataset.dataset import Dataset
from farm.errors import BrokerError
from tests.farm.cli.result import Farm, assert_refused

NO_REDIS = "redis://127.0.0.1:1/0"


@pytest.mark.parametrize("command", ["submit", "worker", "flower"])
def test_no_redis(farm: Farm, tmp_path: Path, command: str) -> None:
    """The error names a Redis that isn't there, and says what to do, before anything is written."""
    options = {"submit": ["--images", "1", "--out", "data"], "worker": ["--store", "."], "flower": []}[command]
    result = farm(command, *options, "--broker", NO_REDIS)
    assert_refused(result, BrokerError.exit_code, "127.0.0.1:1", "--broker")
    assert list(tmp_path.iterdir()) == []


def test_password_is_not_shown(farm: Farm) -> None:
    """An address is shown without its password."""
    result = farm("submit", "--images", "1", "--out", "data", "--broker", "redis://:hush@127.0.0.1:1/0")
    assert_refused(result, BrokerError.exit_code, "redis://***@127.0.0.1:1")
    assert "hush" not in result.stderr


def test_broker_that_is_no_redis(farm: Farm) -> None:
    """A broker that isn't Redis is refused."""
    result = farm("submit", "--images", "1", "--out", "data", "--broker", "amqp://localhost")
    assert_refused(result, BrokerError.exit_code, "amqp://localhost", "redis://")


@pytest.mark.parametrize("command", ["pause", "resume", "cancel", "repair", "watch"])
def test_no_redis_for_a_run(farm: Farm, dataset: Dataset, command: str) -> None:
    """A command that needs the run's Redis says that it isn't there, and changes nothing."""
    before = dataset.storage.files()
    result = farm(command, dataset.storage.location, "--broker", NO_REDIS)
    assert_refused(result, BrokerError.exit_code, "127.0.0.1:1", "--broker")
    assert dataset.storage.files() == before
