"""`--continue`: datasets of another release."""

import json
import shutil
from pathlib import Path

import pytest

from farm.dataset.dataset import open_dataset
from farm.dataset.destination import Destination
from farm.dataset.paths import HEADER_FILE
from farm.dataset.quarantine import put_in_quarantine
from farm.errors import ConflictError, DatasetMissingError, SpecError
from farm.spec.job import Job
from tests.farm.cli.result import Farm, assert_refused

_GOLDEN = Path(__file__).parents[1] / "dataset" / "golden"


@pytest.fixture
def begun(tmp_path: Path) -> Path:
    """A dataset that release 0.1.0 began, of which a picture is missing."""
    folder = tmp_path / "begun"
    shutil.copytree(_GOLDEN / "0.1.0-rooms", folder)
    (folder / "far/manifests/far-000001.json").unlink()
    return folder


@pytest.mark.redis
def test_a_release_goes_on_with_anothers_dataset_if_it_is_told_to(
    farm: Farm, begun: Path, redis_url: str, redis_client: object
) -> None:
    """A repair queues nothing, a submission with --continue queues what is missing, and then a repair may, too."""
    del redis_client  # this fixture empties the queue
    broker = ("--broker", redis_url)
    assert_refused(farm("repair", "begun", *broker), ConflictError.exit_code, "release 0.1.0", "--continue")
    header = (begun / HEADER_FILE).read_bytes()
    told = farm("submit", "--continue", "--out", "begun", *broker)
    assert told.stdout.startswith("1 of 3 images queued"), told.stderr
    assert farm("repair", "begun", *broker).stdout.startswith("0 of 3 images queued")
    assert (begun / HEADER_FILE).read_bytes() == header


@pytest.mark.redis
def test_a_whole_dataset_of_another_release_is_left_as_it_is(
    farm: Farm, tmp_path: Path, redis_url: str, redis_client: object
) -> None:
    """Nothing is missing, so nothing is mixed and nothing is queued."""
    del redis_client
    shutil.copytree(_GOLDEN / "0.1.0-rooms", tmp_path / "whole")
    told = farm("repair", "whole", "--checksums", "--broker", redis_url)
    assert told.stdout.startswith("0 of 3 images queued"), told.stderr


@pytest.mark.parametrize("seed", ["0", "1"])
def test_continue_takes_no_description(farm: Farm, begun: Path, seed: str) -> None:
    """The description is in the folder already."""
    result = farm("run", "--continue", "--seed", seed, "--out", str(begun))
    assert_refused(result, SpecError.exit_code, "--continue takes the description", "--seed")


def test_continue_needs_a_dataset(farm: Farm) -> None:
    """There is nothing to go on with in an empty place."""
    assert_refused(farm("submit", "--continue", "--out", "new"), DatasetMissingError.exit_code, "no dataset here")


@pytest.mark.parametrize(
    ("part", "change", "said"),
    [
        ("surfaces", {"kind": "builtin", "name": "oak", "recipe_version": 999}, "no version 999 of the surface 'oak'"),
        (
            "hdris",
            {"name": "workshop", "path": None, "dark": False, "recipe_version": 999},
            "no version 999 of the environment 'workshop'",
        ),
        ("template", {"path": None, "sha256": "0" * 64}, "another template"),
    ],
)
def test_parts_that_this_release_lacks(farm: Farm, begun: Path, part: str, change: object, said: str) -> None:
    """A surface, environment or template that has changed is told by name, with the release that has it."""
    values = json.loads((begun / HEADER_FILE).read_text())
    values[part] = change if part == "template" else [*values[part], change]
    (begun / HEADER_FILE).write_text(json.dumps(values))
    result = farm("submit", "--continue", "--out", str(begun))
    assert_refused(result, ConflictError.exit_code, "begun by cable-farm 0.1.0", said)


@pytest.mark.redis
def test_a_retry_that_is_refused_keeps_the_records(
    farm: Farm, begun: Path, redis_url: str, redis_client: object
) -> None:
    """What another release gave up stays given up until the user says --continue."""
    del redis_client
    dataset = open_dataset(Destination(str(begun.parent), begun.name))
    put_in_quarantine(dataset, Job.from_id("far-000001"), "died", attempts=3, worker="host:1", log="")
    refused = farm("retry", "begun", "--broker", redis_url)
    assert_refused(refused, ConflictError.exit_code, "release 0.1.0", "--continue")
    assert (begun / "quarantine/far-000001.json").exists()
    told = farm("retry", "begun", "--continue", "--broker", redis_url)
    assert told.stdout.startswith("1 images put back; 1 queued"), told.stderr


@pytest.mark.redis
def test_a_repair_that_is_refused_removes_no_manifest(
    farm: Farm, begun: Path, redis_url: str, redis_client: object
) -> None:
    """A damaged picture of another release keeps its manifest, since this release may not make it again."""
    del redis_client
    (begun / "far/masks/far-000000.png").write_bytes(b"damaged")
    refused = farm("repair", "begun", "--checksums", "--broker", redis_url)
    assert_refused(refused, ConflictError.exit_code, "release 0.1.0", "--continue")
    assert (begun / "far/manifests/far-000000.json").exists()
