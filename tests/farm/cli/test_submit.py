"""`farm submit`."""

import pytest

from farm.errors import ConflictError
from tests.farm.cli.result import Farm, assert_refused


@pytest.mark.redis
def test_submit_queues_once(farm: Farm, redis_url: str, redis_client: object) -> None:
    """A submission is queued; repeated, nothing is added; described otherwise, it is refused."""
    del redis_client  # empties the queue
    options = ["--out", "data", "--broker", redis_url]
    first = farm("submit", "--images", "12", *options)
    assert first.stdout.startswith("12 of 12 images queued"), first.stderr
    again = farm("submit", "--images", "12", *options)
    assert again.stdout.startswith("0 of 12 images queued")
    other = farm("submit", "--images", "12", "--seed", "5", *options)
    assert_refused(other, ConflictError.exit_code, "spec.seed is 0, asked 5", "another --out")
