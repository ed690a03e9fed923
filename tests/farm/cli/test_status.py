"""`farm status` and `farm watch`."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import redis

from farm.cli import continuing
from farm.dataset.dataset import Dataset
from farm.dataset.paths import INDEX_FILE, REPORT_FILE
from farm.dataset.quarantine import put_in_quarantine
from farm.errors import DestinationError, IncompleteError
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle, run_of
from farm.run.ledger.redis import RedisLedger
from farm.run.registry.port import Refusal, RunState, WorkerReport, WorkerState
from farm.run.registry.redis import RedisRegistry
from farm.spec.job import Job
from tests.farm.cli.result import Farm, assert_refused


@pytest.mark.parametrize("command", ["status", "verify", "report"])
def test_no_dataset(farm: Farm, tmp_path: Path, command: str) -> None:
    """A command on a dataset says if there is none."""
    assert_refused(farm(command, "data"), DestinationError.exit_code, "no dataset here")
    assert list(tmp_path.iterdir()) == []


def test_status(farm: Farm, made: Dataset) -> None:
    """Without Redis the folder alone shows the progress."""
    result = farm("status", made.storage.location, "--json")
    progress = json.loads(result.stdout)
    assert progress["categories"]["far"] == {"done": 2, "quota": 2}
    assert progress["running"] is None
    assert "all" in farm("status", made.storage.location).stdout


@pytest.mark.redis
def test_status_names_the_last_picture(farm: Farm, made: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """Even for a finished dataset, the newest picture's path can be opened from anywhere."""
    ledger = RedisLedger(redis_client, run_of(made).key)
    ledger.claim("far-000001", "a:1")
    ledger.finish("far-000001", "a:1", "far/images/far-000001.png")
    result = farm("status", made.storage.location, "--broker", redis_url)
    line = next(line for line in result.stdout.splitlines() if line.startswith("last "))
    assert Path(line.split()[1]).is_absolute()
    assert Path(line.split()[1]).is_file()


@pytest.mark.redis
def test_watch_and_submit_leave_index_and_report(
    farm: Farm, made: Dataset, redis_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After watching or waiting for a dataset its index and page exist, as after `farm run`."""
    monkeypatch.setattr(continuing, "make_header", lambda *_: made.header)
    commands = [("watch", made.storage.location), ("submit", "--images", "1", "--out", made.storage.location, "--wait")]
    for arguments in commands:
        result = farm(*arguments, "--broker", redis_url)
        assert result.returncode == 0, result.stderr
        for name in (INDEX_FILE, REPORT_FILE):
            assert made.storage.read(name)
            made.storage.remove(name)


@pytest.mark.redis
def test_watch_of_a_failure_leaves_index_and_report(farm: Farm, made: Dataset, redis_url: str) -> None:
    """The images that were made are listed, even if the others failed."""
    made.storage.remove("far/manifests/far-000001.json")
    job = Job.from_id("far-000001")
    put_in_quarantine(made, job, "no scene passed", attempts=1, worker="host:1", log="")
    result = farm("watch", made.storage.location, "--broker", redis_url)
    assert result.returncode == IncompleteError.exit_code
    assert len(made.storage.read(INDEX_FILE).splitlines()) == 3
    assert made.storage.read(REPORT_FILE)


@pytest.mark.redis
def test_watch_ends_with_the_dataset(farm: Farm, made: Dataset, redis_url: str) -> None:
    """Watching a finished dataset ends at once."""
    result = farm("watch", made.storage.location, "--broker", redis_url)
    assert result.returncode == 0
    assert "4 of 4 done" in result.stderr


def test_status_names_the_given_up(farm: Farm, made: Dataset) -> None:
    """Even without Redis, given-up images are listed with their reasons, for people and for programs."""
    job = Job.from_id("far-000001")
    made.storage.remove("far/manifests/far-000001.json")
    put_in_quarantine(made, job, "no scene passed", attempts=1, worker="host:1", log="")
    assert "far-000001: no scene passed" in farm("status", made.storage.location).stdout
    as_json = json.loads(farm("status", made.storage.location, "--json").stdout)
    assert as_json["quarantined"] == {"far-000001": "no scene passed"}


@pytest.mark.redis
def test_status_tells_of_workers_and_state(
    farm: Farm, dataset: Dataset, redis_url: str, redis_client: "redis.Redis"
) -> None:
    """A paused run says so, and each worker says what it does or why it does nothing."""
    registry = RedisRegistry(redis_client)
    registry.register(run_of(dataset).model_copy(update={"state": RunState.PAUSED}))
    registry.report(WorkerReport(name="one@host", state=WorkerState.HELD, reason="disk full", done=7))
    shown = farm("status", dataset.storage.location, "--broker", redis_url).stdout
    assert "state    paused" in shown
    assert "worker   one@host held: disk full, 7 done" in shown


def test_a_dataset_in_a_folder_whose_name_is_no_utf8(farm: Farm, made: Dataset, tmp_path: Path) -> None:
    """Old file systems hold such names; the progress is told for programs and people."""
    place = tmp_path / os.fsdecode(b"caf\xe9") / "cables"
    shutil.copytree(made.storage.location, place)
    assert json.loads(farm("status", str(place), "--json").stdout)["location"] == str(place)
    # Most terminals' encoding is strict; that of this process is not.
    done = subprocess.run(
        [sys.executable, "-m", "farm", "status", str(place)],
        env={**os.environ, "PYTHONIOENCODING": "utf-8:strict"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert r"caf\udce9/cables" in done.stdout


@pytest.mark.redis
def test_run_that_nobody_serves(farm: Farm, dataset: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """The status says that no worker serves a run, and why; of a paused one there is nothing to say."""
    place = [dataset.storage.location, "--broker", redis_url]
    handle = open_handle(dataset, redis_url, redis_client, settles=True)
    Coordinator(dataset, handle).submit_missing()
    refuses = {handle.run.key: str(Refusal.NOT_HERE)}
    handle.registry.report(WorkerReport(name="w@host", state=WorkerState.IDLE, release="0.1.0", refuses=refuses))
    words = "no worker serves this run: 1 worker without this dataset in its --store"
    assert f"served   {words}" in farm("status", *place).stdout.splitlines()
    assert json.loads(farm("status", *place, "--json").stdout)["unserved"] == words
    farm("pause", *place)
    assert json.loads(farm("status", *place, "--json").stdout)["unserved"] is None
