"""A worker whose store hangs: its event loop goes on, and what is killed meanwhile counts against nobody."""

import shutil
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from farm.dataset.dataset import Dataset
from farm.run.ledger.owner import process_of_this_machine
from farm.run.registry.port import WorkerState
from tests.doubles.ledger import MemoryLedger
from tests.doubles.registry import MemoryRegistry
from worker.service import backoff as backoff_module
from worker.service.backoff import Backoff
from worker.service.failures import FAILED_IN_A_ROW
from worker.service.job_log import JobLogs
from worker.service.supervisor import Supervisor

NO_PROCESS = 2**22 + 1
"""A process id that no process has."""


class HangingWorker:
    """The main process of a worker whose store hangs until `answers` is set."""

    def __init__(self, folder: Path) -> None:
        self.answers = threading.Event()
        self.ledger = MemoryLedger()
        self.registry = MemoryRegistry()
        self.backoff = Backoff(str(folder / "store"), 0)
        self.supervisor = Supervisor(
            "w@host", lambda: self.registry, lambda *_: self.ledger, self.backoff, JobLogs(folder / "logs"), 2**22
        )

    def kill_children(self, dataset: Dataset) -> None:
        """Have several jobs' processes die, one after the other."""
        for job in list(dataset.header.spec.jobs())[:FAILED_IN_A_ROW]:
            self.ledger.claim(job.id, process_of_this_machine(NO_PROCESS))
            request = SimpleNamespace(kwargs={"message": dataset.message(job).encode()}, worker_pid=NO_PROCESS)
            self.supervisor.note_crash(request)


@pytest.fixture
def worker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[HangingWorker]:
    """A worker that has ticked once since its store began to hang."""
    made = HangingWorker(tmp_path)
    monkeypatch.setattr(backoff_module, "_ANSWER_S", 0.01)
    monkeypatch.setattr(shutil, "disk_usage", lambda _: made.answers.wait() and SimpleNamespace(free=2**40))
    made.supervisor.tick()
    yield made
    made.answers.set()


def test_event_loop_goes_on(worker: HangingWorker) -> None:
    """The supervisor ticks on, and reports why it takes no job, until the store answers."""
    first_s = worker.supervisor.ticked_s
    worker.supervisor.tick()
    assert worker.supervisor.ticked_s > first_s
    (report,) = worker.registry.workers()
    assert report.state is WorkerState.HELD
    assert "gives no answer" in report.reason
    worker.answers.set()
    while worker.backoff.reason():
        time.sleep(0.001)
    worker.supervisor.tick()
    assert worker.registry.workers()[0].state is WorkerState.IDLE


def test_logs_are_looked_at_aside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder for logs that hangs, as one beside the store may, hangs a thread of its own."""
    seen: list[threading.Thread] = []
    monkeypatch.setattr(Supervisor, "_bound_logs", lambda _: seen.append(threading.current_thread()))
    HangingWorker(tmp_path).supervisor.tick()
    while not seen:
        time.sleep(0.001)
    assert seen[0] is not threading.main_thread()


def test_processes_killed_while_the_store_hangs(worker: HangingWorker, dataset: Dataset) -> None:
    """Processes that waited for the store until the time limit count neither against their jobs nor the worker."""
    job = next(iter(dataset.header.spec.jobs()))
    worker.kill_children(dataset)
    assert worker.supervisor.fault is None
    assert worker.ledger.claims() == {}
    assert worker.ledger.claim(job.id, "elsewhere:1") == 1
    worker.ledger.release(job.id, "elsewhere:1")
    worker.answers.set()
    while worker.backoff.reason():
        time.sleep(0.001)
    worker.kill_children(dataset)
    assert worker.supervisor.fault is not None
