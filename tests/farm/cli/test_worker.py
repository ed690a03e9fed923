"""`farm worker`."""

from pathlib import Path

import pytest

from farm.errors import DestinationError
from tests.farm.cli.result import Farm, assert_refused


@pytest.mark.redis
def test_worker_whose_store_is_a_file(farm: Farm, tmp_path: Path, redis_url: str) -> None:
    """A store that can't be read is refused before a job is taken."""
    (tmp_path / "file").write_text("")
    assert_refused(farm("worker", "--store", "file", "--broker", redis_url), DestinationError.exit_code, "file")
