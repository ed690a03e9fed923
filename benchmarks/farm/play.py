"""Run `farm run` as a user does, and read from its dataset when each picture was finished."""

import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

from benchmarks.farm.memory import memory_mib
from benchmarks.farm.rates import Finished, Throughput
from benchmarks.farm.splits import Split
from farm.dataset.completion import job_of_manifest
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.manifest import parse_manifest
from farm.dataset.verify import verify
from farm.errors import VerificationError, error_of
from farm.local.processes import stop
from farm.local.tied import tied

_LOOK_S = 20.0
"""Seconds between two measurements of the memory: each costs 0.1 s of a core, in which the kernel counts pages."""


def play(split: Split, images: int, seed: int, folder: Path, log_file: Path) -> Throughput:
    """Make a dataset in the published mix, and verify it.

    Args:
        split: numbers of workers and threads.
        images: number of images in all.
        seed: seed of the dataset.
        folder: an empty folder for the dataset and the workers' logs.
        log_file: file that receives the command's output.

    Raises:
        VerificationError: if a file is missing or damaged.
        FarmError: the error with which the command ended.
    """
    place = folder / "data"
    started_s, start = time.time(), time.perf_counter()
    peak_mib = run_to_end(_command(split, images, seed, place, folder / "logs"), log_file)
    wall_s = time.perf_counter() - start
    dataset = open_dataset(parse_destination(str(place)))
    verdict = verify(dataset)
    if not verdict.clean or verdict.images != images:
        first = f": {verdict.findings[0]}" if verdict.findings else ""
        raise VerificationError(f"{split}: {verdict.images} of {images} images are as they should be{first}")
    return Throughput(split, finished(dataset, started_s), wall_s, peak_mib)


def finished(dataset: Dataset, started_s: float) -> tuple[Finished, ...]:
    """The moments at which the pictures' manifests were written, the earliest first.

    Args:
        dataset: a complete dataset.
        started_s: start of the run, seconds of the Unix epoch.
    """
    found = []
    for path, stored in dataset.storage.files().items():
        job = job_of_manifest(path)
        manifest = parse_manifest(dataset.storage.read(path), dataset, job) if job else None
        if manifest:
            found.append(Finished(stored.modified_s - started_s, manifest.timings_s.get("open", 0.0) > 0.0))
    return tuple(sorted(found, key=lambda each: each.after_s))


def _command(split: Split, images: int, seed: int, place: Path, logs: Path) -> list[str]:
    command = [sys.executable, "-P", "-m", "farm", "run", "--images", str(images), "--seed", str(seed)]
    command += ["--style", "published", "--no-environments"]
    command += ["--out", str(place), "--logs", str(logs), "--device", "cpu"]
    return [*command, "--workers", str(split.workers), "--threads", str(split.threads)]


def run_to_end(command: list[str], log_file: Path) -> float | None:
    """Run a command of the farm to its end.

    Args:
        command: the program and its arguments.
        log_file: file that receives the command's output.

    Returns:
        Peak memory of all its processes in MiB; None on a system that doesn't measure it.

    Raises:
        FarmError: the error with which the command ended.
    """
    peak_mib: float | None = None
    with log_file.open("wb") as log:
        process = subprocess.Popen(  # noqa: S603  # our own program
            tied(command), stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True
        )
        try:
            while process.poll() is None:
                now_mib = memory_mib(process.pid)
                peak_mib = now_mib if peak_mib is None or now_mib is None else max(peak_mib, now_mib)
                with suppress(subprocess.TimeoutExpired):
                    process.wait(timeout=_LOOK_S)
        finally:
            stop([process], grace_s=5.0)
    if process.returncode:
        last = " ".join(log_file.read_text(errors="replace").strip().splitlines()[-1:])
        text = f"farm run ended with {process.returncode}: {last}; its output is in {log_file}"
        raise error_of(process.returncode, text) or VerificationError(text)
    return peak_mib
