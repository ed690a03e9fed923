"""`farm verify`."""

import json

from farm.collect import write_index
from farm.dataset import Dataset
from farm.errors import VerificationError
from tests.farm.cli.result import Farm


def test_verify_clean(farm: Farm, made: Dataset) -> None:
    """A finished dataset passes, with its index and report in it."""
    write_index(made)
    assert farm("report", made.storage.location).returncode == 0
    result = farm("verify", made.storage.location)
    assert result.returncode == 0, result.stderr
    assert "4 images" in result.stdout


def test_verify_finds(farm: Farm, made: Dataset) -> None:
    """A missing and an extra file are listed, and the exit code tells."""
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
