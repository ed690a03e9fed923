"""The command line. Each command has its own module; a failure that the farm foresees ends in one line."""

import signal
import sys
from io import TextIOWrapper
from types import FrameType
from typing import Annotated

import typer

from farm import __version__
from farm.cli.assets import assets_app
from farm.cli.control import cancel, pause, resume
from farm.cli.doctor import doctor
from farm.cli.flower import flower
from farm.cli.mending import repair, retry
from farm.cli.metrics import metrics
from farm.cli.preview import preview
from farm.cli.ranges import ranges
from farm.cli.replay import replay
from farm.cli.report import report
from farm.cli.run import run
from farm.cli.status import status, watch
from farm.cli.submit import submit
from farm.cli.verify import verify
from farm.cli.worker import worker
from farm.errors import FarmError

app = typer.Typer(
    name="farm",
    help="A render farm that makes labelled pictures of cables for training robots.",
    no_args_is_help=True,
    add_completion=False,
    # A traceback of a defect belongs to its report whole, and without the values of variables.
    pretty_exceptions_enable=False,
)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and end.")
    ] = False,
) -> None:
    """Declare the program's own options; the application above holds the help text."""


COMMANDS = (
    *(run, submit, worker, status, watch, pause, resume, cancel),
    *(repair, retry, replay, verify, report, preview, ranges, doctor, flower, metrics),
)
for command in COMMANDS:
    app.command()(command)
app.add_typer(assets_app, name="assets")


def end_on_signals() -> None:
    """Make SIGTERM and SIGHUP raise SystemExit, so that every `with` closes and ends the processes it started."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _end)


def _end(number: int, _frame: FrameType | None) -> None:
    sys.exit(128 + number)


def main() -> None:
    """Run the command line; see `farm.errors` for the exit codes."""
    end_on_signals()
    if isinstance(sys.stdout, TextIOWrapper):
        # A path may hold letters, or bytes that are no text, which the terminal's encoding lacks.
        sys.stdout.reconfigure(errors="backslashreplace")
    try:
        app()
    except FarmError as error:
        sys.stderr.write(f"farm: {error}\n")
        sys.exit(error.exit_code)
