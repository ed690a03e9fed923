"""Measure jobs per second through real Redis and real Celery workers whose renderer does almost nothing."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.verify import verify
from farm.errors import VerificationError
from farm.local.processes import stop
from farm.local.redis_server import PrivateRedis
from farm.local.tied import tied
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle
from farm.run.progress import RunHandle
from farm.run.queue.broker import BROKER_VARIABLE, connect
from farm.run.worker_settings import WorkerSettings
from tests.load.processor_time import processor_s
from tests.stand_in import StandInRenderer, stand_in_header

_STAND_IN = Path(__file__).parents[1] / "stand_in.py"
_PATIENCE_S = 60.0
_IDLE_S = 20.0


@dataclass(frozen=True, slots=True)
class JobCost:
    """The cost of a run with a number of workers.

    Attributes:
        workers: number of workers.
        jobs: number of the dataset's jobs.
        wall_s: wall seconds from the first job's submission to the last one's end.
        workers_s: processor seconds of the workers and their children, without those of the stand-in renderer.
        redis_s: processor seconds of Redis.
        coordinator_s: processor seconds of the process that submits and watches.
        idle_redis_s: processor seconds of Redis per second without any job, while workers listen and report.
    """

    workers: int
    jobs: int
    wall_s: float
    workers_s: float
    redis_s: float
    coordinator_s: float
    idle_redis_s: float

    @property
    def jobs_per_s(self) -> float:
        """Finished jobs per second."""
        return self.jobs / self.wall_s

    @property
    def cpu_ms(self) -> float:
        """CPU time of all processes per job, milliseconds."""
        return 1000.0 * (self.workers_s + self.redis_s + self.coordinator_s) / self.jobs


def measure_jobs(workers: int, jobs: int, seed: int) -> JobCost:
    """Run a dataset of this many jobs, and measure it.

    Raises:
        VerificationError: if the dataset is incomplete or disagrees with its manifests.
        FarmError: if the run fails.
    """
    with PrivateRedis() as server, tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        client = connect(server.url)
        dataset = create_dataset(Destination(folder, "cables"), stand_in_header(seed=seed, far=jobs))
        handle = open_handle(dataset, server.url, client)
        coordinator = Coordinator(dataset, handle, poll_s=0.2)
        redis_process = int(client.info("server")["process_id"])
        with _stand_ins(workers, folder, server.url, handle) as processes:
            idle_redis_s = _idle(redis_process)
            making_s = jobs * _stand_in_s(dataset)
            before = processor_s(processes), processor_s([redis_process]), time.process_time()
            start_s = time.perf_counter()
            coordinator.submit_missing()
            coordinator.watch()
            wall_s = time.perf_counter() - start_s
            after = processor_s(processes), processor_s([redis_process]), time.process_time()
        verdict = verify(dataset)
        if not verdict.clean or verdict.images != jobs:
            raise VerificationError(f"{workers} workers: {verdict.images} of {jobs} images are as they should be")
    spent = [end - start for start, end in zip(before, after, strict=True)]
    return JobCost(workers, jobs, wall_s, max(0.0, spent[0] - making_s), spent[1], spent[2], idle_redis_s)


def _idle(redis_process: int) -> float:
    before_s = processor_s([redis_process])
    time.sleep(_IDLE_S)
    return (processor_s([redis_process]) - before_s) / _IDLE_S


def _stand_in_s(dataset: Dataset, times: int = 200) -> float:
    """CPU seconds that the stand-in renderer takes for one picture, which aren't the farm's."""
    renderer, jobs = StandInRenderer(), list(dataset.header.spec.jobs())
    standard_output = os.dup(1)
    with Path(os.devnull).open("w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
        start_s = time.process_time()
        for number in range(times):
            renderer.make(jobs[number % len(jobs)], dataset.header)
        taken_s = time.process_time() - start_s
        sys.stdout.flush()
        os.dup2(standard_output, 1)
    os.close(standard_output)
    return taken_s / times


@contextmanager
def _stand_ins(count: int, store: str, url: str, handle: RunHandle) -> Iterator[list[int]]:
    environment = {**os.environ, BROKER_VARIABLE: url, "PYTHONPATH": str(_STAND_IN.parents[1])}
    started = []
    try:
        for number in range(count):
            settings = WorkerSettings(
                store=store, name=f"load-{number}", logs=Path(store) / "logs", tasks_per_child=1_000_000
            )
            started.append(
                subprocess.Popen(
                    tied([sys.executable, "-P", str(_STAND_IN), *settings.serve_arguments()]),
                    env=environment,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    start_new_session=True,
                )
            )
        give_up_s = time.monotonic() + _PATIENCE_S
        while len(handle.registry.workers()) < count and time.monotonic() < give_up_s:
            time.sleep(0.1)
        yield [process.pid for process in started]
    finally:
        stop(started, grace_s=10.0)
