"""Starting the worker's program as a process of its own: `farm` never imports it, since it loads Blender."""

import contextlib
import importlib.util
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Self

from farm.aside import Aside
from farm.environment import own_environment
from farm.errors import MachineError, RenderError, error_of
from farm.local.workers import WORKER_COMMAND
from farm.run.queue.broker import BROKER_VARIABLE
from farm.run.worker_settings import DeviceChoice, RendererSettings, WorkerSettings
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.start import become


def blender_is_installed() -> bool:
    """Whether Blender's Python module is installed; it isn't loaded."""
    return importlib.util.find_spec("bpy") is not None


def require_blender() -> None:
    """Make sure that Blender's Python module is installed.

    Raises:
        MachineError: if it is not.
    """
    if not blender_is_installed():
        raise MachineError("Blender (bpy) is not installed; run: pip install 'cable-farm[worker]'")


def become_worker(settings: WorkerSettings, broker_url: str) -> None:
    """Become a worker in place of this process, so that signals reach it; does not return."""
    become("worker.__main__", settings.serve_arguments(), **{BROKER_VARIABLE: broker_url})


def check_device(device: DeviceChoice, logs: Path) -> None:
    """Make sure, in a process of its own, that Blender loads here and has the device.

    Raises:
        MachineError: if not.
        DestinationError: if the log folder can't be written.
    """
    ask_worker(["device"], None, logs, renderer=RendererSettings(device=device))


@dataclass(frozen=True, slots=True)
class PictureFiles:
    """The files that take one picture and its mask."""

    picture: Path
    mask: Path

    @classmethod
    def in_folder(cls, folder: Path, job: Job) -> Self:
        """Name the files of a job's picture in a folder."""
        return cls(folder / f"{job.id}.png", folder / f"{job.id}-mask.png")


def make_picture(header: DatasetHeader, job: Job, files: PictureFiles, renderer: RendererSettings, logs: Path) -> None:
    """Have the worker's program make one picture.

    Raises:
        FarmError: the kind that belongs to the program's exit code.
        RenderError: if the program ended well and a file is not there, or is the one that was there before.
    """
    before = [_identity(path) for path in (files.picture, files.mask)]
    arguments = ["preview", "--job", job.id, "--out", str(files.picture), "--mask", str(files.mask)]
    ask_worker(arguments, header, logs, renderer=renderer)
    for path, former in zip((files.picture, files.mask), before, strict=True):
        if _identity(path) in {None, former}:
            raise RenderError(f"{path}: the worker's program told no error but wrote no picture; see the log in {logs}")


def _identity(path: Path) -> tuple[int, int] | None:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_ino, found.st_mtime_ns


def ask_worker(
    arguments: Sequence[str],
    header: DatasetHeader | None,
    logs: Path,
    told: Callable[[str], None] | None = None,
    *,
    renderer: RendererSettings | None = None,
) -> None:
    """Run one of the commands of the worker's program to its end.

    Args:
        arguments: command, with the options that are its own.
        header: dataset's header, for commands that read one from standard input.
        logs: folder for what Blender prints.
        told: called with each line that the command prints, as soon as it is there; None to let it print itself.
        renderer: settings of the renderer; None for the usual ones.

    Raises:
        FarmError: the kind that belongs to the command's exit code, with its message.
    """
    settings = renderer or RendererSettings()
    command = [*WORKER_COMMAND, *arguments, "--renderer", settings.as_argument(), "--logs", str(logs)]
    with subprocess.Popen(  # noqa: S603 - our own program and arguments
        command,
        env=own_environment(),
        stdin=subprocess.PIPE,
        stdout=None if told is None else subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        # Errors are read aside: their pipe could fill up while the lines of the other are read.
        errors = Aside(partial(_read_all, process))
        errors.begin()
        _hand_over(process, b"" if header is None else header.model_dump_json().encode())
        for line in process.stdout or ():
            if told is not None:
                told(line.decode(errors="replace").rstrip("\n"))
        errors.wait(None)
    said = errors.answer or b""
    if process.returncode != 0:
        message = said.decode(errors="replace").strip() or f"it ended with code {process.returncode}"
        defect = RenderError(f"the worker's program failed; its log is in {logs}: {message.splitlines()[-1]}")
        raise error_of(process.returncode, message) or defect


def _read_all(process: "subprocess.Popen[bytes]") -> bytes:
    return b"" if process.stderr is None else process.stderr.read()


def _hand_over(process: "subprocess.Popen[bytes]", content: bytes) -> None:
    if process.stdin is not None:
        # A command that ended without reading has said why.
        with contextlib.suppress(BrokenPipeError), process.stdin:
            process.stdin.write(content)
