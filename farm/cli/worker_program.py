"""Starting the worker's own program. This package never imports it: it loads Blender."""

import importlib.util
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from farm.errors import EnvironmentMissingError, RenderError, error_of
from farm.header import DatasetHeader
from farm.local.workers import WORKER_COMMAND
from farm.queue.broker import BROKER_VARIABLE


def blender_is_installed() -> bool:
    """Whether Blender's Python module is there, told without loading it."""
    return importlib.util.find_spec("bpy") is not None


def require_blender() -> None:
    """Make sure that Blender's Python module is installed.

    Raises:
        EnvironmentMissingError: if it is not.
    """
    if not blender_is_installed():
        raise EnvironmentMissingError("Blender (bpy) is not installed; run: pip install 'cable-farm[worker]'")


def become_worker(arguments: Sequence[str], broker_url: str) -> None:
    """Replace this process by a worker, which then gets its signals itself. Does not return."""
    command = [*WORKER_COMMAND, *arguments]
    sys.stdout.flush()
    sys.stderr.flush()
    environment = {**os.environ, BROKER_VARIABLE: broker_url}
    os.execve(command[0], command, environment)  # noqa: S606 - no shell is wanted


def check_device(device: str, logs: Path) -> None:
    """Make sure that Blender loads here and has the device; in a process of its own.

    Raises:
        EnvironmentMissingError: if not.
        DestinationError: if the log folder can't be written.
    """
    ask_worker(["device", "--device", device], None, logs)


def ask_worker(arguments: Sequence[str], header: DatasetHeader | None, logs: Path) -> None:
    """Run one of the worker's commands, on a header if it takes one, to its end.

    Raises:
        FarmError: of the kind of the worker's exit code, with its message.
    """
    result = subprocess.run(  # noqa: S603 - our own program and arguments
        [*WORKER_COMMAND, *arguments, "--logs", str(logs)],
        input=b"" if header is None else header.model_dump_json().encode(),
        stderr=subprocess.PIPE,
        check=False,
    )
    if result.returncode != 0:
        message = result.stderr.decode(errors="replace").strip() or f"it ended with code {result.returncode}"
        defect = RenderError(f"the worker's program failed; its log is in {logs}: {message.splitlines()[-1]}")
        raise error_of(result.returncode, message) or defect
