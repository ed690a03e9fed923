"""Shared fixtures of the commands' tests: a way to run one, and a finished dataset."""

import signal
import sys
from pathlib import Path

import pytest

from farm.cli import main
from farm.dataset.dataset import Dataset
from tests.farm.cli.result import Farm, Result
from tests.stand_in import StandInRenderer
from worker.service.upload import upload


@pytest.fixture
def farm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Farm:
    """A function that runs a command in a folder of its own, in this process, which saves a start."""
    monkeypatch.chdir(tmp_path)
    for name in ("FARM_BROKER_URL", "FARM_STORE", "FARM_ASSETS", "FARM_INPUTS", "FARM_LOGS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(signal, "signal", lambda *_: None)

    def run(*arguments: str) -> Result:
        capsys.readouterr()  # discard what fixtures printed
        monkeypatch.setattr(sys, "argv", ["farm", *arguments])
        with pytest.raises(SystemExit) as ended:
            main()
        printed = capsys.readouterr()
        return Result(int(ended.value.code or 0), printed.out, printed.err)

    return run


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset
