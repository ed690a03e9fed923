"""Start a worker in a fresh process, and read the time of each step."""

import json
import subprocess
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.startup.imports import OWN, seconds_by_library
from farm.errors import VerificationError
from farm.spec.header import DatasetHeader
from farm.spec.job import Job

Seconds = Mapping[str, float]

_PROGRAM = [sys.executable, "-X", "importtime", "-m", "benchmarks.startup.timeline"]


@dataclass(frozen=True, slots=True)
class Start:
    """The time of one start, in seconds.

    Attributes:
        interpreter_s: time from the request for the process to its first line.
        main: time of the imports of the worker's main process, by library.
        child: time of the further imports of its child, by library.
        open_s: time to open the template and choose the device.
        first: time of the first picture, by stage.
        second: time of the same picture made again, by stage.
        read: number of compiled functions that were read from disk.
        compiled: number of functions that had to be compiled.
        device: device that rendered.
    """

    interpreter_s: float
    main: Seconds
    child: Seconds
    open_s: float
    first: Seconds
    second: Seconds
    read: int
    compiled: int
    device: str

    @property
    def until_first_picture_s(self) -> float:
        """Time from the request for the process to the first picture."""
        return self.until_open_s + sum(self.first.values())

    @property
    def until_open_s(self) -> float:
        """Time from the request for the process until a picture can begin."""
        return self.interpreter_s + sum(self.main.values()) + sum(self.child.values()) + self.open_s


def start_once(header: DatasetHeader, job: Job, folder: Path) -> Start:
    """Start a process that makes a picture twice.

    Args:
        header: header of the picture's dataset.
        job: the picture's job.
        folder: destination of the result and the process's output.

    Raises:
        VerificationError: if the process made no picture, or two different ones.
    """
    result, output, imports = (folder / name for name in ("start.json", "output.log", "imports.log"))
    result.unlink(missing_ok=True)
    with output.open("wb") as out, imports.open("wb") as errors:
        task = f"{header.model_dump_json()}\n{job.id}".encode()
        command = [*_PROGRAM, repr(time.perf_counter()), str(result)]
        code = subprocess.run(command, input=task, stdout=out, stderr=errors, check=False).returncode  # noqa: S603  # our own program
    lines = imports.read_text(errors="replace")
    if code != 0 or not result.exists():
        said = [line for line in lines.splitlines() if line and not line.startswith("import time:")]
        raise VerificationError(f"a worker's start made no picture: {said[-1] if said else f'exit code {code}'}")
    return read_start(json.loads(result.read_text()), lines)


def read_start(content: Mapping[str, Any], imports: str) -> Start:
    """Read a start from the output of its process.

    Args:
        content: content of the JSON file that `benchmarks.startup.watch` writes.
        imports: lines of `python -X importtime`.

    Raises:
        VerificationError: if the two pictures differ.
    """
    first, second = content["pictures"]
    if first["sha256"] != second["sha256"]:
        raise VerificationError("the same job made two different pictures in one process")
    steps = content["steps"]
    return Start(
        interpreter_s=steps["interpreter"],
        main=_by_library(imports, "worker.cli", steps["main"]),
        child=_by_library(imports, "worker.blender.renderer", steps["child"]),
        open_s=content["open_s"],
        first=first["seconds"],
        second=second["seconds"],
        read=content["compiled"]["read"],
        compiled=content["compiled"]["compiled"],
        device=first["device"],
    )


def _by_library(imports: str, root: str, all_s: float) -> Seconds:
    """Seconds by library; time that no module accounts for counts as the farm's own modules."""
    seconds = seconds_by_library(imports, root)
    seconds[OWN] = max(0.0, all_s - sum(seconds.values()) + seconds.get(OWN, 0.0))
    return seconds
