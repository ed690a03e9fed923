"""`farm run`: make a dataset on this machine, with a Redis and workers that end with the command."""

from typing import Annotated

import typer

from farm.cli.baking import bake_for
from farm.cli.continuing import GoOn, wanted_dataset
from farm.cli.display import ProgressDisplay, console
from farm.cli.options import (
    Assets,
    DatasetOptions,
    Device,
    InputFolders,
    Logs,
    MinFree,
    Out,
    input_places,
    log_folder,
    takes_dataset_options,
)
from farm.cli.worker_program import ask_worker, check_device, require_blender
from farm.dataset.dataset import find_dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.paths import REPORT_FILE
from farm.dataset.release import refuse_to_mix
from farm.dataset.report import write_overview
from farm.errors import IncompleteError
from farm.local.run import LocalRun, default_workers, run_locally
from farm.machine import usable_cores
from farm.run.worker_settings import MIN_FREE_MIB, DeviceChoice, RendererSettings


@takes_dataset_options
def run(  # noqa: PLR0913, PLR0917 - every option is a parameter
    options: DatasetOptions,
    out: Out,
    workers: Annotated[
        int | None,
        typer.Option(
            min=1, max=256, help="Workers, each with a Blender; default: one for each core, at most one for each 2 GiB."
        ),
    ] = None,
    device: Device = DeviceChoice.AUTO,
    threads: Annotated[
        int | None,
        typer.Option(min=1, help="Threads of each worker's renderer; default: the cores divided by the workers."),
    ] = None,
    assets: Assets = None,
    inputs: InputFolders = None,
    logs: Logs = None,
    min_free_mib: MinFree = MIN_FREE_MIB,
    go_on: GoOn = False,
) -> None:
    """Make a dataset here and now, with a private Redis and workers that end with it.

    Repeat the command to complete a dataset that was interrupted.
    """
    destination = parse_destination(out)
    wanted = wanted_dataset(options, destination, go_on=go_on)
    header = wanted.header
    places = input_places(inputs, *wanted.inputs.places)
    require_blender()
    present = find_dataset(destination, header)  # a conflict is told before surfaces are drawn, which may take minutes
    if present is not None and not go_on:
        refuse_to_mix(present)
    screen = console()
    check_device(device, log_folder(logs))
    bake_for(header, assets, screen)
    if wanted.inputs.template is not None:
        ask_worker(["check"], header, log_folder(logs))
    workers = workers or default_workers()
    threads = threads or max(1, usable_cores() // workers)
    renderer = RendererSettings(device=device, threads=threads, assets=assets, inputs=places)
    how = LocalRun(workers, renderer, log_folder(logs), min_free_mib=min_free_mib, mixes=go_on)
    with ProgressDisplay(screen) as display:
        try:
            progress = run_locally(destination, header, how, display.show)
        except IncompleteError:
            # The images that were made are worth a look.
            screen.print(f"the workers' logs are in {how.logs}", markup=False)
            write_overview(open_dataset(destination))
            raise
        except (KeyboardInterrupt, SystemExit):
            screen.print("stopped; repeat the command to make what is missing")
            raise
    write_overview(open_dataset(destination))
    typer.echo(f"{progress.done} images in {progress.location}; look at {progress.location}/{REPORT_FILE}")
