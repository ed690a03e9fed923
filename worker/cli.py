"""The worker's command line, which the farm's own calls; here the maker is wired in."""

import argparse
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Protocol

from pydantic import ValidationError

from assets.environments import DEFAULT_WIDTH
from farm.errors import FarmError, MachineError, MessageError
from farm.run.queue.broker import broker_url
from farm.run.queue.settings import HARD_LIMIT_S, MEMORY_PER_CHILD_KIB, MIN_FREE_MIB, TASKS_PER_CHILD
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.storage import LocalStorage
from worker.service.cores import limit_visible_cores
from worker.service.picture import Renderer
from worker.service.process import WorkerSettings, prepare_log, send_output_to, serve
from worker.service.runner import OpenRenderer
from worker.service.upload import encode_png


class OpenBlender(Protocol):
    """Opens what makes a dataset's pictures."""

    def __call__(self, header: DatasetHeader, *, device: str, threads: int, assets: Path | None) -> Renderer:
        """Open it in the calling process.

        Raises:
            FarmError: if the template, an asset or the device is not what it must be.
        """
        ...


def _open_blender(header: DatasetHeader, *, device: str, threads: int, assets: Path | None) -> Renderer:
    with limit_visible_cores(threads):
        # Importing it loads Blender, which must not be in a process that forks.
        from worker.blender.renderer import open_renderer  # noqa: PLC0415

    return open_renderer(header, device=device, threads=threads, assets=assets)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m worker", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    render = argparse.ArgumentParser(add_help=False)
    render.add_argument("--device", default="auto", help="where Cycles renders")
    render.add_argument("--threads", type=int, default=0, help="threads of the renderer; 0: all cores")
    render.add_argument("--assets", type=Path, help="folder of the baked surfaces")
    render.add_argument("--logs", type=Path, required=True, help="folder for what Blender writes")

    work = commands.add_parser("serve", parents=[render], help="take jobs until told to stop")
    work.add_argument("--store", required=True, help="folder or URL below which the datasets lie")
    work.add_argument("--name", required=True, help="unique on this host")
    work.add_argument("--concurrency", type=int, default=1)
    work.add_argument("--tasks-per-child", type=int, default=TASKS_PER_CHILD)
    work.add_argument("--memory-per-child-kib", type=int, default=MEMORY_PER_CHILD_KIB)
    work.add_argument("--time-limit-s", type=float, default=HARD_LIMIT_S)
    work.add_argument("--min-free-mib", type=int, default=MIN_FREE_MIB)

    commands.add_parser("check", parents=[render], help="open what renders; the dataset's header comes by stdin")

    commands.add_parser("device", parents=[render], help="load Blender and find the device")

    rooms = commands.add_parser("environments", parents=[render], help="render the environments that a folder lacks")
    rooms.add_argument("--out", type=Path, required=True, help="folder of the baked surfaces; they go below it")
    rooms.add_argument("--pixels", type=int, default=DEFAULT_WIDTH, help="width of the panoramas")
    rooms.add_argument("--name", action="append", help="only this one; repeat it")

    one = commands.add_parser("preview", parents=[render], help="one picture; the dataset's header comes by stdin")
    one.add_argument("--job", required=True)
    one.add_argument("--out", type=Path, required=True)
    one.add_argument("--mask", type=Path)
    return parser


def main(arguments: list[str], open_renderer: OpenBlender = _open_blender) -> int:
    """Run a worker's command.

    Args:
        arguments: as on the command line.
        open_renderer: the function that opens the renderer of a dataset.

    Returns:
        The exit code.
    """
    options = _parser().parse_args(arguments)
    open_renderer = partial(open_renderer, device=options.device, threads=options.threads, assets=options.assets)
    try:
        if options.command == "check":
            return _check(options, open_renderer)
        if options.command == "device":
            return _device(options)
        if options.command == "environments":
            return _environments(options)
        if options.command == "preview":
            return _preview(options, open_renderer)
        settings = WorkerSettings(
            store=options.store,
            # The address may hold a password, so it comes by the environment: arguments are public.
            broker_url=broker_url(None),
            name=options.name,
            log_folder=options.logs,
            concurrency=options.concurrency,
            tasks_per_child=options.tasks_per_child,
            memory_per_child_kib=options.memory_per_child_kib,
            time_limit_s=options.time_limit_s,
            min_free_bytes=options.min_free_mib * 2**20,
        )
        return serve(settings, open_renderer)
    except FarmError as error:
        sys.stderr.write(f"{error}\n")
        return error.exit_code


def _check(options: argparse.Namespace, open_renderer: OpenRenderer) -> int:
    with _output_in(options.logs / "check.log"):
        open_renderer(_read_header())
    return 0


def _device(options: argparse.Namespace) -> int:
    with _output_in(options.logs / "check.log"):
        try:
            # It loads Blender, as above.
            from blend.devices import choose_device  # noqa: PLC0415
        except ImportError as error:
            raise MachineError(f"Blender does not load: {error}; try farm doctor") from error
        choose_device(options.device)
    return 0


def _environments(options: argparse.Namespace) -> int:
    """Render them; the name of each goes to standard output as soon as it is on disk, for the farm to count."""
    names = None if options.name is None else tuple(options.name)
    with _output_in(options.logs / "environments.log") as screen:
        try:
            # It loads Blender, as above.
            from blend.environments.render import render_environments  # noqa: PLC0415
        except ImportError as error:
            raise MachineError(f"Blender does not load: {error}; try farm doctor") from error
        for name in render_environments(
            options.out, pixels=options.pixels, names=names, device=options.device, threads=options.threads
        ):
            os.write(screen, f"{name}\n".encode())
    return 0


def _preview(options: argparse.Namespace, open_renderer: OpenRenderer) -> int:
    header, job = _read_header(), Job.from_id(options.job)
    with _output_in(options.logs / "preview.log"):
        made = open_renderer(header).make(job, header)
    # Both are encoded before the first is written, so that a failure leaves nothing.
    contents = [(options.out, encode_png(made.image))]
    if options.mask is not None:
        contents.append((options.mask, encode_png(made.mask)))
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
    """Send all output to a file; gives the descriptor of what was standard output."""
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
