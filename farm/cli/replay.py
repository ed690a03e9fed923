"""`farm replay`: makes one of a dataset's images again on this machine, to see why it failed."""

from pathlib import Path
from typing import Annotated

import typer

from farm.cli.baking import bake_for
from farm.cli.display import console
from farm.cli.options import Assets, DatasetPlace, Device, InputFolders, Logs, input_places, job_of, log_folder
from farm.cli.worker_program import PictureFiles, make_picture, require_blender
from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.errors import DestinationError, SpecError
from farm.run.worker_settings import DeviceChoice, RendererSettings


def replay(
    place: DatasetPlace,
    job_id: Annotated[str, typer.Argument(metavar="JOB", help="Id of the image, such as far-000042.")],
    out: Annotated[Path, typer.Option(help="Folder for the picture and its mask.")] = Path(),
    device: Device = DeviceChoice.AUTO,
    threads: Annotated[int, typer.Option(min=0, help="Threads of the renderer; 0: all cores.")] = 0,
    assets: Assets = None,
    inputs: InputFolders = None,
    logs: Logs = None,
) -> None:
    """Make one of a dataset's images again, in another folder: the dataset does not change."""
    job = job_of(job_id)
    dataset = open_dataset(parse_destination(place))
    if not dataset.asks_for(job):
        raise SpecError(f"{job.id}: outside the quotas of {dataset.storage.location}")
    if out.exists() and not out.is_dir():
        raise DestinationError(f"{out}: this is a file; name a folder with --out")
    if not out.is_dir():
        raise DestinationError(f"{out}: no such folder; make it first")
    require_blender()
    bake_for(dataset.header, assets, console())
    files = PictureFiles.in_folder(out, job)
    renderer = RendererSettings(device=device, threads=threads, assets=assets, inputs=input_places(inputs))
    with console().status(f"making {job.id}"):
        make_picture(dataset.header, job, files, renderer, log_folder(logs))
    typer.echo(f"{files.picture} and {files.mask}")
