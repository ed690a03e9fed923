"""Measure the cost of a submission by its size, with `farm submit` as a user calls it."""

import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.errors import VerificationError
from farm.local.redis_server import PrivateRedis
from farm.run.feeder import WINDOW
from farm.run.handle import open_handle
from farm.run.queue.broker import connect


@dataclass(frozen=True, slots=True)
class SubmissionCost:
    """The cost of one `farm submit`.

    Attributes:
        images: number of images of the dataset.
        wall_s: wall seconds of the command.
        cpu_s: processor seconds of the command.
        peak_mib: largest resident memory of the command, MiB.
        waiting: number of jobs in the queue afterwards.
        redis_mib: memory that Redis uses afterwards, MiB.
    """

    images: int
    wall_s: float
    cpu_s: float
    peak_mib: float
    waiting: int
    redis_mib: float


def measure_submission(images: int, seed: int) -> SubmissionCost:
    """Submit a fresh dataset to an empty Redis, with no worker.

    Raises:
        VerificationError: if the command fails, or the queue doesn't hold every job, or a window of them, once each.
    """
    with PrivateRedis() as server, tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        place = str(Path(folder) / "cables")
        command = [sys.executable, "-P", "-m", "farm", "submit", "--images", str(images), "--seed", str(seed)]
        start_s = time.perf_counter()
        process = subprocess.Popen([*command, "--out", place, "--broker", server.url], stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        wall_s = time.perf_counter() - start_s
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise VerificationError(f"farm submit of {images} images ended with {process.returncode}")
        client = connect(server.url)
        dataset = open_dataset(parse_destination(place))
        handle = open_handle(dataset, server.url, client)
        waiting = [job.id for job in handle.queue.queued(handle.run)]
        if len(waiting) != min(images, WINDOW) or len(set(waiting)) != len(waiting):
            raise VerificationError(f"{len(waiting)} jobs wait after a submission of {images}")
        return SubmissionCost(
            images=images,
            wall_s=wall_s,
            cpu_s=used.ru_utime + used.ru_stime,
            peak_mib=used.ru_maxrss / 1024,
            waiting=len(waiting),
            redis_mib=client.info("memory")["used_memory"] / 2**20,
        )
