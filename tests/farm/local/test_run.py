"""Whole runs with a private Redis and real Celery workers, whose renderer needs no Blender; and their faults."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import Destination
from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import file_path
from farm.dataset.verify import verify
from farm.errors import DestinationError, IncompleteError, MachineError
from farm.local.run import LocalRun, run_locally
from farm.run.progress import Progress
from farm.run.worker_settings import RendererSettings
from farm.spec.header import DatasetHeader
from tests.live_farm import processes_with, wait_for
from tests.stand_in import stand_in_header

pytestmark = pytest.mark.redis

PATIENCE_S = 60.0


@pytest.fixture
def how(tmp_path: Path, worker_command: list[str]) -> LocalRun:
    """Options for two workers."""
    return LocalRun(
        workers=2,
        renderer=RendererSettings(),
        logs=tmp_path / "logs",
        worker_command=worker_command,
        lost_after_s=1.0,
    )


@pytest.fixture
def destination(tmp_path: Path) -> Destination:
    """A free place for a dataset."""
    return Destination(str(tmp_path / "store"), "cables")


def servers_of(parent: int) -> set[int]:
    """The Redis servers that a process has started."""
    return {process for process, started_by in processes_with("redis-server").items() if started_by == parent}


def once(action: Callable[[], None], after: int) -> Callable[[Progress], None]:
    """Act once, when a number of images are done."""
    acted = False

    def look(progress: Progress) -> None:
        nonlocal acted
        if not acted and progress.done >= after and progress.running:
            acted = True
            action()

    return look


def assert_whole(destination: Destination, made: Progress, logs: Path) -> Dataset:
    """Assert that the quota is full, every file is right, there is no other, and each image was finished once."""
    dataset = open_dataset(destination)
    assert made.done == made.quota == dataset.header.spec.total
    assert verify(dataset).findings == ()
    finished = [line for log in logs.glob("*.log") for line in log.read_text().splitlines() if " done in " in line]
    names = [word for line in finished for word in line.split() if word.startswith("cables:")]
    assert sorted(names) == sorted(dataset.message(job).task_id for job in dataset.header.spec.jobs())
    return dataset


def test_run(destination: Destination, header: DatasetHeader, how: LocalRun) -> None:
    """A run makes every image once, from submission to manifest, and leaves no process behind."""
    made = run_locally(destination, header, how)
    assert_whole(destination, made, how.logs)
    assert processes_with(str(how.logs)) == {}


def test_chatter_goes_to_the_log(
    destination: Destination, header: DatasetHeader, how: LocalRun, capfd: pytest.CaptureFixture[str]
) -> None:
    """What a renderer prints is in the job's log, not in the terminal."""
    run_locally(destination, header, how)
    assert "noise of Blender" not in "".join(capfd.readouterr())
    assert any("noise of Blender" in log.read_text() for log in how.logs.glob("jobs/*/*.log"))


def test_second_run_has_nothing_to_do(destination: Destination, header: DatasetHeader, how: LocalRun) -> None:
    """A run of a finished dataset leaves it as it is."""
    run_locally(destination, header, how)
    before = open_dataset(destination).storage.files()
    assert run_locally(destination, header, how).done == 4
    assert open_dataset(destination).storage.files() == before


def test_number_of_workers_decides_nothing(tmp_path: Path, header: DatasetHeader, how: LocalRun) -> None:
    """One worker or two make the same bytes."""
    pictures = []
    for workers, name in ((1, "one"), (2, "two")):
        destination = Destination(str(tmp_path / name), "cables")
        run_locally(destination, header, replace(how, workers=workers))
        storage = open_dataset(destination).storage
        paths = [file_path(job, output) for job in header.spec.jobs() for output in OUTPUTS]
        pictures.append([storage.read(path) for path in paths])
    assert pictures[0] == pictures[1]


@pytest.mark.slow
@pytest.mark.parametrize("victim", ["child", "worker"])
def test_killed_process(destination: Destination, how: LocalRun, monkeypatch: pytest.MonkeyPatch, victim: str) -> None:
    """If a renderer's process or a whole worker is killed, the run still makes every image, once each."""
    monkeypatch.setenv("STAND_IN_DELAY_S", "0.4")

    def kill() -> None:
        processes = processes_with(str(how.logs))
        children = [process for process, parent in processes.items() if parent in processes]
        mains = [process for process in processes if process not in children]
        os.kill(children[0] if victim == "child" else mains[0], signal.SIGKILL)

    made = run_locally(destination, stand_in_header(far=10, close_distributed_light=4), how, once(kill, after=2))
    assert_whole(destination, made, how.logs)


@pytest.mark.slow
def test_killed_redis(destination: Destination, how: LocalRun, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """If the private Redis is killed, it restarts empty, and the run makes every image, once each."""
    monkeypatch.setenv("STAND_IN_DELAY_S", "0.2")
    monkeypatch.setenv("STAND_IN_STARTS", str(tmp_path / "starts"))
    others = servers_of(os.getpid())
    killed: list[int] = []

    def kill() -> None:
        (server,) = servers_of(os.getpid()) - others
        killed.append(server)
        os.kill(server, signal.SIGKILL)

    header = stand_in_header(far=10, close_distributed_light=4)
    made = run_locally(destination, header, how, once(kill, after=3))
    assert len(killed) == 1
    assert made.done == made.quota == 14
    assert verify(open_dataset(destination)).clean
    # A job that ran at that moment may begin twice.
    assert len((tmp_path / "starts").read_text().splitlines()) <= 14 + how.workers
    assert servers_of(os.getpid()) == others


@pytest.mark.slow
@pytest.mark.swift
def test_killed_worker_of_a_bucket(bucket: str, how: LocalRun, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a worker is killed, a run into a bucket still makes every image, once each."""
    monkeypatch.setenv("STAND_IN_DELAY_S", "0.4")
    monkeypatch.delenv("AWS_MAX_ATTEMPTS")

    def kill() -> None:
        processes = processes_with(str(how.logs))
        mains = [process for process, parent in processes.items() if parent not in processes]
        os.kill(mains[0], signal.SIGKILL)

    destination = Destination(bucket, "cables")
    made = run_locally(destination, stand_in_header(far=8), how, once(kill, after=2))
    dataset = assert_whole(destination, made, how.logs)
    assert len(dataset.storage.files("far/manifests")) == 8
    assert not any(os.environ["AWS_SECRET_ACCESS_KEY"] in log.read_text() for log in how.logs.rglob("*.log"))
    assert processes_with(str(how.logs)) == {}


def test_job_that_always_kills_its_process(
    destination: Destination, header: DatasetHeader, how: LocalRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A job that always takes its process with it ends as a failure, and the others are made."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=crash")
    with pytest.raises(IncompleteError, match=r"far-000001: its process died"):
        run_locally(destination, header, how)
    verdict = verify(open_dataset(destination))
    assert verdict.clean
    assert list(verdict.quarantined) == ["far-000001"]


def test_permanent_failure(
    destination: Destination, header: DatasetHeader, how: LocalRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A job that can't succeed ends the run with its reason once the others are done."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=permanent")
    with pytest.raises(IncompleteError, match=r"1 of 4 .*\n  far-000001: no scene passed the checks"):
        run_locally(destination, header, how)
    assert processes_with(str(how.logs)) == {}


@pytest.mark.slow
def test_passing_failure(
    destination: Destination, header: DatasetHeader, how: LocalRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A job that fails once is tried again after a pause, by Celery's own means, and the quota is full."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=once")
    made = run_locally(destination, header, replace(how, workers=1))
    assert_whole(destination, made, how.logs)


def test_worker_that_does_not_start(destination: Destination, header: DatasetHeader, how: LocalRun) -> None:
    """A worker that ends at each start ends the run, and the error holds the last line of its log."""
    broken = replace(how, worker_command=[sys.executable, "-c", "raise SystemExit('no such library')"])
    with pytest.raises(MachineError, match="no such library"):
        run_locally(destination, header, broken)


def test_unfit_worker_ends_the_run(
    destination: Destination, header: DatasetHeader, how: LocalRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Something that this machine lacks ends the run at once with its own error, and no job has failed."""
    monkeypatch.setenv("STAND_IN_UNFIT", "--device optix: no such device")
    with pytest.raises(MachineError, match=r"optix: no such device; .*log"):
        run_locally(destination, header, how)
    monkeypatch.delenv("STAND_IN_UNFIT")
    assert run_locally(destination, header, how).done == 4


def test_logs_that_cannot_be_written(
    destination: Destination, header: DatasetHeader, how: LocalRun, tmp_path: Path
) -> None:
    """A log folder that can't be made is reported as such."""
    (tmp_path / "file").write_text("")
    with pytest.raises(DestinationError, match="file/logs: can't write logs"):
        run_locally(destination, header, replace(how, logs=tmp_path / "file/logs"))


@pytest.fixture
def running(destination: Destination, how: LocalRun, worker_command: list[str]) -> Iterator["subprocess.Popen[bytes]"]:
    """A run in its own process, under way, with pictures that take long."""
    program = Path(__file__).with_name("stand_in_run.py")
    process = subprocess.Popen(
        [sys.executable, "-P", str(program), destination.location, str(how.logs), worker_command[-1]],
        env={**os.environ, "STAND_IN_DELAY_S": "30", "PYTHONPATH": str(Path(__file__).parents[3])},
        stderr=subprocess.PIPE,
    )
    try:
        wait_for(lambda: len(processes_with(str(how.logs))) == 5)  # the run, two workers and their children
        yield process
    finally:
        process.kill()
        process.communicate()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_stopped_run_leaves_no_process(
    running: "subprocess.Popen[bytes]", how: LocalRun, destination: Destination, number: signal.Signals
) -> None:
    """However a run is stopped, its Redis and workers end with it, and the dataset can be completed."""
    servers = servers_of(running.pid)
    assert len(servers) == 1
    running.send_signal(number)
    running.wait(PATIENCE_S)
    wait_for(lambda: not processes_with(str(how.logs)))
    wait_for(lambda: not (processes_with("redis-server").keys() & servers))
    made = run_locally(destination, open_dataset(destination).header, how)
    assert made.done == made.quota
