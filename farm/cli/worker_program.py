"""Starting the worker's own program. This package never imports it: it loads Blender."""

import contextlib
import importlib.util
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from farm.errors import MachineError, RenderError, error_of
from farm.local.workers import WORKER_COMMAND
from farm.run.queue.broker import BROKER_VARIABLE
from farm.spec.header import DatasetHeader


def blender_is_installed() -> bool:
    """Whether Blender's Python module is there, told without loading it."""
    return importlib.util.find_spec("bpy") is not None


def require_blender() -> None:
    """Make sure that Blender's Python module is installed.

    Raises:
        MachineError: if it is not.
    """
    if not blender_is_installed():
        raise MachineError("Blender (bpy) is not installed; run: pip install 'cable-farm[worker]'")


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
        MachineError: if not.
        DestinationError: if the log folder can't be written.
    """
    ask_worker(["device", "--device", device], None, logs)


def ask_worker(
    arguments: Sequence[str],
    header: DatasetHeader | None,
    logs: Path,
    told: Callable[[str], None] | None = None,
) -> None:
    """Run one of the worker's commands, on a header if it takes one, to its end.

    Args:
        arguments: of the worker's program.
        header: for its standard input.
        logs: folder for what Blender prints.
        told: gets each line that it prints as soon as it is there; None to let it print itself.

    Raises:
        FarmError: of the kind of the worker's exit code, with its message.
    """
    command = [*WORKER_COMMAND, *arguments, "--logs", str(logs)]
    # Into a file, not a pipe: nobody empties a pipe while lines are read from the other.
    with tempfile.TemporaryFile() as errors:
        with subprocess.Popen(  # noqa: S603 - our own program and arguments
            command, stdin=subprocess.PIPE, stdout=None if told is None else subprocess.PIPE, stderr=errors
        ) as process:
            _hand_over(process, b"" if header is None else header.model_dump_json().encode())
            for line in process.stdout or ():
                if told is not None:
                    told(line.decode(errors="replace").rstrip("\n"))
        errors.seek(0)
        said = errors.read()
    if process.returncode != 0:
        message = said.decode(errors="replace").strip() or f"it ended with code {process.returncode}"
        defect = RenderError(f"the worker's program failed; its log is in {logs}: {message.splitlines()[-1]}")
        raise error_of(process.returncode, message) or defect


def _hand_over(process: "subprocess.Popen[bytes]", content: bytes) -> None:
    if process.stdin is not None:
        # One that ended without reading has said why.
        with contextlib.suppress(BrokenPipeError), process.stdin:
            process.stdin.write(content)
