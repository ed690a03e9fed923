"""`farm verify`."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from farm.dataset.dataset import Dataset
from farm.dataset.index import write_index
from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import file_path, manifest_path
from farm.dataset.quarantine import put_in_quarantine
from farm.errors import IncompleteError, VerificationError
from farm.spec.job import Job
from tests.farm.cli.result import Farm, assert_refused

IMAGE_PATH = "far/images/far-000001.png"


def test_verify_clean(farm: Farm, made: Dataset) -> None:
    """A finished dataset passes, and its index and report count as its own files."""
    write_index(made)
    assert farm("report", made.storage.location).returncode == 0
    result = farm("verify", made.storage.location)
    assert result.returncode == 0, result.stderr
    assert "4 images" in result.stdout


def test_verify_finds(farm: Farm, made: Dataset) -> None:
    """A missing and an extra file are listed, and the exit code says so."""
    made.storage.remove("far/masks/far-000001.png")
    made.storage.write("far/stray.txt", b"")
    result = farm("verify", made.storage.location)
    assert result.returncode == VerificationError.exit_code
    assert "1 extra, 1 missing" in result.stderr
    assert "missing: far/masks/far-000001.png" in result.stderr
    as_json = farm("verify", made.storage.location, "--json")
    assert as_json.returncode == VerificationError.exit_code
    assert {finding["path"] for finding in json.loads(as_json.stdout)["findings"]} == {
        "far/masks/far-000001.png",
        "far/stray.txt",
    }


@pytest.mark.parametrize(
    ("spoil", "advice"),
    [
        (lambda folder: os.truncate(folder / IMAGE_PATH, 20), "farm repair --checksums {} has the damaged pictures"),
        (lambda folder: (folder / IMAGE_PATH).write_bytes(b"x" * 9999), "farm repair --checksums {} has the damaged"),
        (lambda folder: (folder / IMAGE_PATH).unlink(), "run or submit it again"),
        (lambda folder: (folder / "mine").mkdir() or (folder / "mine/1").write_text(""), "they may be yours"),
    ],
)
def test_verify_never_advises_to_remove(
    farm: Farm, made: Dataset, spoil: Callable[[Path], object], advice: str
) -> None:
    """Whatever is found, the advice is a command that mends it, and never to remove files."""
    spoil(Path(made.storage.location))
    told = farm("verify", made.storage.location).stderr
    assert advice.format(made.storage.location) in told
    assert "remove" not in told


def test_verify_of_a_dataset_with_given_up_images(farm: Farm, made: Dataset) -> None:
    """A dataset that lacks only given-up images has an exit code of its own, and the output says what to do."""
    job = Job.from_id("far-000001")
    for path in (manifest_path(job), *(file_path(job, output) for output in OUTPUTS)):
        made.storage.remove(path)
    put_in_quarantine(made, job, "no scene passed", attempts=1, worker="host:1", log="")
    result = farm("verify", made.storage.location)
    assert_refused(result, IncompleteError.exit_code, "3 images", "1 are in quarantine", "farm retry")
    as_json = json.loads(farm("verify", made.storage.location, "--json").stdout)
    assert as_json["quarantined"] == {"far-000001": "no scene passed"}
