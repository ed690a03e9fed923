"""`farm preview`: makes one picture at once, without queue or dataset."""

import os
from pathlib import Path
from typing import Annotated

import typer

from farm.cli.baking import bake_for
from farm.cli.display import console
from farm.cli.installed_assets import InstalledAssets
from farm.cli.options import (
    Assets,
    DatasetOptions,
    Device,
    InputFolders,
    Logs,
    input_places,
    log_folder,
    takes_dataset_options,
)
from farm.cli.worker_program import PictureFiles, make_picture, require_blender
from farm.errors import DestinationError, SpecError
from farm.run.worker_settings import DeviceChoice, RendererSettings
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.make_header import make_header


@takes_dataset_options
def preview(  # noqa: PLR0913, PLR0917 - every option is a parameter
    options: DatasetOptions,
    category: Annotated[Category, typer.Option(help="Category of the picture.", show_default=False)],
    index: Annotated[int, typer.Option(min=0, help="Number of the picture in its category, from 0.")] = 0,
    out: Annotated[Path, typer.Option(help="File of the picture; its mask goes beside it.")] = Path("preview.png"),
    device: Device = DeviceChoice.AUTO,
    threads: Annotated[int, typer.Option(min=0, help="Threads of the renderer; 0: all cores.")] = 0,
    assets: Assets = None,
    inputs: InputFolders = None,
    logs: Logs = None,
) -> None:
    """Make one picture, and its mask, as the described dataset would hold them."""
    if options.images is not None or options.quota:
        raise SpecError("farm preview makes one image: leave --images and --quota out")
    if out.suffix != ".png":
        raise DestinationError(f"{out}: a preview is a PNG; let its name end in .png")
    if not out.parent.is_dir():
        raise DestinationError(f"{out}: there is no folder {out.parent}; make it first")
    if not os.access(out.parent, os.W_OK):
        raise DestinationError(f"{out}: can't be written; check the rights of {out.parent}")
    mask = out.with_name(f"{out.stem}-mask.png")
    if taken := next((path for path in (out, mask) if path.is_dir()), None):
        raise DestinationError(f"{taken}: this is a folder; name a file with --out")
    description = options.describe(quotas={str(category): index + 1})
    header = make_header(description.spec, description.inputs, InstalledAssets())
    places = input_places(inputs, *description.inputs.places)
    require_blender()
    bake_for(header, assets, console())
    job = Job(category=category, index=index)
    renderer = RendererSettings(device=device, threads=threads, assets=assets, inputs=places)
    with console().status(f"making {job.id}"):
        make_picture(header, job, PictureFiles(out, mask), renderer, log_folder(logs))
    typer.echo(f"{out} and {mask}")
