"""`--continue`: goes on with a dataset as its `dataset.json` describes it, whichever release began it."""

from dataclasses import dataclass, fields
from typing import Annotated

import typer

from assets.environments import ENVIRONMENTS
from assets.surfaces.catalogue import SURFACES
from farm.cli.installed_assets import InstalledAssets
from farm.cli.options import DatasetOptions
from farm.dataset.dataset import open_dataset
from farm.dataset.destination import Destination
from farm.errors import ConflictError, SpecError
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader
from farm.spec.make_header import Inputs, make_header, template_ref

GoOn = Annotated[
    bool,
    typer.Option("--continue", help="Go on with the dataset in --out as it was begun, by whichever release."),
]


@dataclass(frozen=True, slots=True)
class Wanted:
    """The dataset that a command is to make.

    Attributes:
        header: its header.
        inputs: files of this machine that it uses, as the user names them.
    """

    header: DatasetHeader
    inputs: Inputs


def wanted_dataset(options: DatasetOptions, destination: Destination, *, go_on: bool) -> Wanted:
    """Find out which dataset a command is to make: the one that the options describe, or the one in its place.

    Raises:
        DatasetMissingError: if there is none to go on with.
        ConflictError: if this release has other built-in surfaces, environments or another template.
        FarmError: if the options describe no dataset, or its files can't be used.
    """
    if not go_on:
        description = options.describe()
        header = make_header(description.spec, description.inputs, InstalledAssets())
        return Wanted(header, description.inputs)
    values = {field.name: getattr(options, field.name) for field in fields(options)}
    given = [name for name, value in values.items() if value is not None and value is not False]
    if given:
        flag = given[0].replace("_", "-")
        raise SpecError(f"--continue takes the description from the dataset.json in --out; leave out --{flag}")
    header = open_dataset(destination).header
    if lacks := _what_is_lacking(header):
        raise ConflictError(
            f"{destination.location}: begun by cable-farm {header.farm_version}: {lacks}; finish it with that release"
        )
    return Wanted(header, Inputs())


def _what_is_lacking(header: DatasetHeader) -> str:
    """Find the first built-in part of a dataset that this release does not have as it was; empty if it has all."""
    for surface in header.surfaces:
        if isinstance(surface, BuiltinSurfaceRef):
            recipe = SURFACES.get(surface.name)
            if recipe is None or recipe.version != surface.recipe_version:
                return f"this release draws no version {surface.recipe_version} of the surface '{surface.name}'"
    builtin = {(hdri.name, hdri.sha256) for hdri in InstalledAssets().builtin_hdris()}
    for hdri in header.hdris:
        if hdri.path is None and hdri.recipe_version is None and (hdri.name, hdri.sha256) not in builtin:
            return f"this release's Blender comes with another HDRI '{hdri.name}'"
        environment = ENVIRONMENTS.get(hdri.name)
        if hdri.recipe_version is not None and (environment is None or environment.version != hdri.recipe_version):
            return f"this release renders no version {hdri.recipe_version} of the environment '{hdri.name}'"
    if header.template.path is None and template_ref(None).sha256 != header.template.sha256:
        return "this release comes with another template"
    return ""
