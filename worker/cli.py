"""The worker's program, which the farm's own processes start; it connects the jobs with the renderer."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from assets.environments import DEFAULT_WIDTH
from farm.dataset.outputs import IMAGE, MASK
from farm.errors import FarmError, MachineError, MessageError
from farm.run.queue.broker import broker_url
from farm.run.worker_settings import RendererSettings, WorkerSettings
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.storage import LocalStorage
from worker.service.cores import limit_visible_cores
from worker.service.kept_renderer import OpenRenderer
from worker.service.picture import Renderer
from worker.service.process import serve
from worker.service.process_log import prepare_log, send_output_to

T = TypeVar("T")


def _open_blender(header: DatasetHeader, settings: RendererSettings) -> Renderer:
    with limit_visible_cores(settings.threads):
        # Importing it loads Blender, which must not be in a process that forks.
        from worker.blender.renderer import open_renderer  # noqa: PLC0415

    return open_renderer(header, settings)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m worker", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)

    work = commands.add_parser("serve", help="take jobs until told to stop")
    work.add_argument("settings", type=_read(WorkerSettings.from_argument), help="the worker's settings, as JSON")

    once = argparse.ArgumentParser(add_help=False)
    once.add_argument(
        "--renderer",
        type=_read(RendererSettings.from_argument),
        default=RendererSettings(),
        help="the renderer's settings, as JSON",
    )
    once.add_argument("--logs", type=Path, required=True, help="folder for what Blender prints")

    commands.add_parser("check", parents=[once], help="open the renderer; the dataset's header comes by stdin")

    commands.add_parser("device", parents=[once], help="load Blender and find the device")

    rooms = commands.add_parser("environments", parents=[once], help="render the environments that a folder lacks")
    rooms.add_argument("--out", type=Path, required=True, help="folder of the baked surfaces, which takes them")
    rooms.add_argument("--pixels", type=int, default=DEFAULT_WIDTH, help="width of the panoramas")
    rooms.add_argument("--name", action="append", help="environment to render, by default all; may be repeated")

    one = commands.add_parser("preview", parents=[once], help="make one picture; the dataset's header comes by stdin")
    one.add_argument("--job", type=_read(_job), required=True, help="id of the picture's job")
    one.add_argument("--out", type=Path, required=True, help="file for the picture")
    one.add_argument("--mask", type=Path, help="file for its mask")
    return parser


def _job(text: str) -> Job:
    try:
        return Job.from_id(text)
    except MessageError as error:
        raise ValueError(str(error)) from error


def _read(convert: Callable[[str], T]) -> Callable[[str], T]:
    """Make a type of argument whose errors keep their own message."""

    def read(text: str) -> T:
        try:
            return convert(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return read


def main(arguments: list[str], open_renderer: OpenRenderer = _open_blender) -> int:
    """Run one of the program's commands.

    Args:
        arguments: words of the command line.
        open_renderer: the function that opens the renderer of a dataset.

    Returns:
        The exit code; wrong arguments end the process with 2.
    """
    options = _parser().parse_args(arguments)
    try:
        if options.command == "check":
            return _check(options, open_renderer)
        if options.command == "device":
            return _device(options)
        if options.command == "environments":
            return _environments(options)
        if options.command == "preview":
            return _preview(options, open_renderer)
        # The address may hold a password, so it comes by the environment: arguments are public.
        return serve(options.settings, broker_url(None), open_renderer)
    except FarmError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_code


def _check(options: argparse.Namespace, open_renderer: OpenRenderer) -> int:
    with _output_in(options.logs / "check.log"):
        open_renderer(_read_header(), options.renderer)
    return 0


def _device(options: argparse.Namespace) -> int:
    with _output_in(options.logs / "check.log"):
        try:
            # Importing it loads Blender.
            from blend.devices import choose_device  # noqa: PLC0415
        except ImportError as error:
            raise MachineError(f"Blender does not load: {error}; try farm doctor") from error
        choose_device(options.renderer.device)
    return 0


def _environments(options: argparse.Namespace) -> int:
    """Render environments; the name of each goes to standard output once it is on disk, for the farm to count."""
    names = None if options.name is None else tuple(options.name)
    renderer: RendererSettings = options.renderer
    with _output_in(options.logs / "environments.log") as screen:
        try:
            # Importing it loads Blender.
            from blend.environments.render import render_environments  # noqa: PLC0415
        except ImportError as error:
            raise MachineError(f"Blender does not load: {error}; try farm doctor") from error
        for name in render_environments(
            options.out, pixels=options.pixels, names=names, device=renderer.device, threads=renderer.threads
        ):
            os.write(screen, f"{name}\n".encode())
    return 0


def _preview(options: argparse.Namespace, open_renderer: OpenRenderer) -> int:
    header, job = _read_header(), options.job
    with _output_in(options.logs / "preview.log"):
        made = open_renderer(header, options.renderer).make(job, header)
    # Both are encoded before the first is written, so that a failure leaves nothing.
    contents = [(options.out, IMAGE.format.encode(made.files[IMAGE.role]))]
    if options.mask is not None:
        contents.append((options.mask, MASK.format.encode(made.files[MASK.role])))
    for path, content in contents:
        LocalStorage(path.parent).write(path.name, content)
    return 0


def _read_header() -> DatasetHeader:
    try:
        return DatasetHeader.model_validate_json(sys.stdin.buffer.read())
    except ValidationError as error:
        raise MessageError(f"the dataset's header on stdin is not readable: {error.error_count()} errors") from error


@contextmanager
def _output_in(log_file: Path) -> Iterator[int]:
    """Send all output to a file inside `with`; yields the descriptor of the standard output before."""
    prepare_log(log_file.parent, log_file.name)
    errors, screen = os.dup(2), os.dup(1)
    send_output_to(log_file)
    try:
        yield screen
    finally:
        os.close(screen)
        # From here on the terminal is wanted again, for an error's line.
        sys.stderr.flush()
        os.dup2(errors, 2)
        os.close(errors)
