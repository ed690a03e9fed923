"""Measure what commands take that read a finished dataset: in seconds from a slow store, and in memory by its size."""

import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass

from farm.errors import VerificationError

PLAYED = ("status", "status", "overview", "overview", "verify")
"""Commands in the order in which they are played: those that come twice find what the first has left."""


@dataclass(frozen=True, slots=True)
class ReadingCost:
    """The cost of one command on a finished dataset.

    Attributes:
        command: `status`, `overview`, which is what `farm report` and the end of a run do, or `verify`.
        images: number of pictures.
        latency_ms: time that the store takes for each request, ms.
        done: number of pictures that the command found done.
        seconds: wall seconds.
        cpu_s: processor seconds.
        peak_mib: largest resident memory of the command's process, MiB.
        reads_of_manifests: manifests that it read.
        reads: files that it read.
        pages: pages of listings, of a thousand files each.
    """

    command: str
    images: int
    latency_ms: float
    done: int
    seconds: float
    cpu_s: float
    peak_mib: float
    reads_of_manifests: int
    reads: int
    pages: int


def measure_reading(images: int, latency_ms: float) -> list[ReadingCost]:
    """Play the commands on a synthetic dataset, each in a process of its own.

    Raises:
        VerificationError: if one fails or does not find every picture done.
    """
    costs = []
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        for command in PLAYED:
            arguments = [sys.executable, "-m", "tests.load.synthetic", command, str(images), str(latency_ms), folder]
            played = subprocess.run(arguments, stdout=subprocess.PIPE, check=False)
            if played.returncode:
                raise VerificationError(f"{command} of {images} pictures ended with {played.returncode}")
            cost = ReadingCost(**json.loads(played.stdout))
            if cost.done != cost.images:
                raise VerificationError(f"{command} found {cost.done} of {cost.images} pictures done")
            costs.append(cost)
    return costs
