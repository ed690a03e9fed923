"""`farm repair`, `farm retry` and the refusals of `farm replay`."""

import json
import shutil
from pathlib import Path

import pytest
import redis

from farm.dataset.dataset import Dataset
from farm.dataset.header_file import header_content
from farm.dataset.outputs import MASK
from farm.dataset.paths import HEADER_FILE, PLACE_FILE, file_path, manifest_path
from farm.dataset.quarantine import Quarantine, put_in_quarantine
from farm.errors import ConflictError, DestinationError, SpecError
from farm.run.handle import open_handle
from farm.spec.job import Job
from tests.farm.cli.result import USAGE, Farm, assert_refused
from tests.stand_in import stand_in_header

JOB = Job.from_id("far-000001")
OTHER = Job.from_id("far-000000")


@pytest.fixture
def lacking(made: Dataset) -> Dataset:
    """A dataset of which two images were given up."""
    for job in (JOB, OTHER):
        made.storage.remove(manifest_path(job))
        put_in_quarantine(made, job, "died", attempts=3, worker="host:1", log="")
    return made


def queued(dataset: Dataset, redis_url: str, client: "redis.Redis") -> list[str]:
    """The waiting images."""
    handle = open_handle(dataset, redis_url, client)
    return sorted(job.id for job in handle.queue.queued(handle.run))


@pytest.mark.redis
def test_repair_queues_what_is_missing(farm: Farm, made: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """An image one of whose files is gone is queued, once, however often this is asked for."""
    made.storage.remove(file_path(JOB, MASK))
    place = [made.storage.location, "--broker", redis_url]
    assert farm("repair", *place).stdout.startswith("1 of 4 images queued")
    assert farm("repair", *place).stdout.startswith("0 of 4 images queued")
    assert queued(made, redis_url, redis_client) == [JOB.id]


@pytest.mark.redis
def test_repair_of_a_whole_dataset(farm: Farm, made: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """A repair queues nothing of a whole dataset and leaves its files, also with checksums."""
    before = made.storage.files()
    result = farm("repair", made.storage.location, "--checksums", "--broker", redis_url)
    assert result.stdout.startswith("0 of 4 images queued")
    assert {path: file for path, file in made.storage.files().items() if path != PLACE_FILE} == before
    assert queued(made, redis_url, redis_client) == []


@pytest.mark.redis
def test_repair_leaves_the_given_up(farm: Farm, lacking: Dataset, redis_url: str) -> None:
    """A repair doesn't queue jobs that were given up."""
    result = farm("repair", lacking.storage.location, "--broker", redis_url)
    assert result.stdout.startswith("0 of 4 images queued")


@pytest.mark.redis
def test_retry_of_one(farm: Farm, lacking: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """The named image is put back and queued with no attempts counted; the other stays given up."""
    handle = open_handle(lacking, redis_url, redis_client, settles=True)
    handle.ledger.claim(JOB.id, "a:1")
    handle.ledger.release(JOB.id, "a:1")
    result = farm("retry", lacking.storage.location, JOB.id, "--broker", redis_url)
    assert result.stdout.startswith("1 images put back; 1 queued"), result.stderr
    assert queued(lacking, redis_url, redis_client) == [JOB.id]
    assert list(Quarantine(lacking).look()) == [OTHER.id]
    assert handle.ledger.claim(JOB.id, "a:1") == 1


@pytest.mark.redis
def test_retry_of_all(farm: Farm, lacking: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """Without a name all images are put back."""
    result = farm("retry", lacking.storage.location, "--broker", redis_url)
    assert result.stdout.startswith("2 images put back; 2 queued"), result.stderr
    assert queued(lacking, redis_url, redis_client) == [OTHER.id, JOB.id]
    assert Quarantine(lacking).look() == {}


def test_retry_without_redis(farm: Farm, lacking: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without Redis, images are put back for the next run."""
    monkeypatch.setenv("FARM_BROKER_URL", "redis://127.0.0.1:1/0")
    result = farm("retry", lacking.storage.location)
    assert result.stdout.startswith("2 images put back; farm run or farm submit"), result.stderr
    assert Quarantine(lacking).look() == {}


def test_retry_with_a_redis_that_is_not_there(farm: Farm, lacking: Dataset) -> None:
    """A named Redis that isn't there ends the command."""
    result = farm("retry", lacking.storage.location, "--broker", "redis://127.0.0.1:1/0")
    assert "127.0.0.1:1" in result.stderr
    assert result.returncode == 8
    assert len(Quarantine(lacking).look()) == 2


def test_retry_of_what_was_not_given_up(farm: Farm, lacking: Dataset) -> None:
    """A name that isn't in quarantine is refused, and nothing is put back, not even the names that are."""
    result = farm("retry", lacking.storage.location, JOB.id, "close_concentrated_light-000000")
    assert_refused(result, SpecError.exit_code, "not in quarantine")
    assert len(Quarantine(lacking).look()) == 2


@pytest.mark.parametrize("command", ["replay", "retry"])
@pytest.mark.parametrize(
    ("job_id", "words"),
    [
        ("far-42", "do you mean far-000042?"),
        ("far-0000042", "do you mean far-000042?"),
        ("near-000042", "categories are"),
        ("far", "as in far-000042"),
        ("../far", "as in far-000042"),
        ("", "as in far-000042"),
        ("far-00004²", "as in far-000042"),
        ("far-9999999999", "as in far-000042"),
        (f"far-{'9' * 5000}", "as in far-000042"),
    ],
)
def test_wrong_id_is_wrong_usage(farm: Farm, lacking: Dataset, command: str, job_id: str, words: str) -> None:
    """A typing error in an id names the argument and the form of an id, with the exit code of a wrong argument."""
    result = farm(command, lacking.storage.location, job_id)
    assert result.returncode == USAGE
    told = " ".join(result.stderr.replace("│", " ").split())
    assert "JOB" in told
    assert words in told
    assert len(Quarantine(lacking).look()) == 2


@pytest.mark.parametrize(
    ("job_id", "options", "kind", "words"),
    [
        ("far-000002", [], SpecError, "outside the quotas"),
        ("far-000001", ["--out", "nowhere"], DestinationError, "nowhere"),
        ("far-000001", ["--out", "file"], DestinationError, "file: this is a file"),
    ],
)
def test_replay_that_cannot_be(
    farm: Farm, made: Dataset, tmp_path: Path, job_id: str, options: list[str], kind: type[SpecError], words: str
) -> None:
    """An impossible replay is refused before Blender is loaded, and the dataset stays as it is."""
    (tmp_path / "file").touch()
    before = made.storage.files()
    assert_refused(farm("replay", made.storage.location, job_id, *options), kind.exit_code, words)
    assert {path: file for path, file in made.storage.files().items() if path != PLACE_FILE} == before
    assert list(tmp_path.glob("*.png")) == []


@pytest.mark.redis
def test_repair_keeps_what_a_checksum_confirms(farm: Farm, made: Dataset, redis_url: str) -> None:
    """Where dataset.json was replaced, its whole pictures stay, and the repair says what to put back."""
    made.storage.write(HEADER_FILE, header_content(stand_in_header(seed=7)))
    before = made.storage.files()
    result = farm("repair", made.storage.location, "--checksums", "--broker", redis_url)
    assert_refused(
        result, ConflictError.exit_code, "whole pictures of another description", "put back the dataset.json"
    )
    assert {path: file for path, file in made.storage.files().items() if path != PLACE_FILE} == before


@pytest.mark.redis
def test_a_copy_is_whole(farm: Farm, made: Dataset, tmp_path: Path, redis_url: str, redis_client: object) -> None:
    """A copied and renamed dataset is clean and complete, and a repair with checksums leaves all of it."""
    del redis_client
    shutil.copytree(made.storage.location, tmp_path / "cables (copy)")
    assert farm("verify", "cables (copy)").returncode == 0
    status = json.loads(farm("status", "cables (copy)", "--json").stdout)
    assert sum(category["done"] for category in status["categories"].values()) == 4
    repaired = farm("repair", "cables (copy)", "--checksums", "--broker", redis_url)
    assert repaired.stdout.startswith("0 of 4 images queued"), repaired.stderr
