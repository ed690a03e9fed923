"""The options that several commands share, declared once."""

import functools
import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated, Any

import typer

from farm.errors import MessageError, SpecError
from farm.machine import expanded, state_folder
from farm.run.worker_settings import DeviceChoice
from farm.scene.picture_size import read_resolution
from farm.spec.category import Category
from farm.spec.dataset_spec import Engine
from farm.spec.job import MAX_INDEX, Job
from farm.spec.parse import Description, describe, parse_quotas
from farm.spec.quality import read_quality
from farm.spec.simulation import Simulator
from farm.spec.styles import Style

_DATASET = "What to make"


Broker = Annotated[
    str | None,
    typer.Option(help="The Redis: redis://HOST:PORT/NUMBER. Default: FARM_BROKER_URL, else redis://localhost:6379/0."),
]
DatasetPlace = Annotated[str, typer.Argument(metavar="DATASET", help="The dataset's folder or URL.")]
Out = Annotated[str, typer.Option("--out", help="The dataset's folder or URL; made if it is not there.")]
Device = Annotated[DeviceChoice, typer.Option(help="Where Cycles renders; auto takes a GPU if there is one.")]
Assets = Annotated[
    Path | None,
    typer.Option("--assets", envvar="FARM_ASSETS", help="Folder of the baked surfaces; default: the user's own."),
]
InputFolders = Annotated[
    list[Path] | None,
    typer.Option(
        "--inputs",
        envvar="FARM_INPUTS",
        metavar="DIR",
        help="Folder to look in for textures, HDRIs, photographs and templates that are elsewhere here; repeat it.",
    ),
]
Logs = Annotated[Path | None, typer.Option("--logs", envvar="FARM_LOGS", help="Folder for what Blender prints.")]
MinFree = Annotated[
    int,
    typer.Option("--min-free-mib", min=0, help="MiB of free space on the store's disk below which no picture is made."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for programs.")]


def input_places(given: Sequence[Path] | None, *more: Path | None) -> tuple[Path, ...]:
    """Make the places where a renderer looks for a dataset's files absolute, since it may run in another folder."""
    return tuple(expanded(str(path)).absolute() for path in (*(given or ()), *more) if path is not None)


def log_folder(given: Path | None) -> Path:
    """Choose the folder for logs: the one given, else one below the user's folder for programs' state."""
    if given is not None:
        return given.resolve()
    return state_folder() / "logs"


def job_of(job_id: str) -> Job:
    """Read the argument JOB of a command.

    Raises:
        typer.BadParameter: if it is not the id of an image; the command ends as with any wrong argument.
    """
    try:
        return Job.from_id(job_id)
    except MessageError:
        number = job_id.rpartition("-")[2]
        is_number = number.isascii() and number.isdecimal() and len(number) <= len(str(MAX_INDEX))
        nearest = f"{job_id.rpartition('-')[0]}-{int(number):06d}" if is_number else ""
        meant = f"; do you mean {nearest}?" if _is_job_id(nearest) else f"; categories are {', '.join(Category)}"
        raise typer.BadParameter(
            f"{job_id[:80]!a} is no id of an image; write CATEGORY-NUMBER with six digits, as in far-000042{meant}",
            param_hint="'JOB'",
        ) from None


def _is_job_id(text: str) -> bool:
    try:
        Job.from_id(text)
    except MessageError:
        return False
    return True


@dataclass(frozen=True, slots=True, kw_only=True)
class DatasetOptions:
    """The options that describe a dataset: one for each field, with its help."""

    spec_file: Annotated[
        Path | None, typer.Argument(metavar="[SPEC.toml]", help="The dataset's description.", show_default=False)
    ] = None
    spec: Annotated[
        Path | None, typer.Option(metavar="FILE", help="The same, as an option.", rich_help_panel=_DATASET)
    ] = None
    images: Annotated[
        int | None, typer.Option(help="Images in all, split 2:2:1:1:2:2 as published.", rich_help_panel=_DATASET)
    ] = None
    quota: Annotated[
        list[str] | None,
        typer.Option(metavar="CATEGORY=NUMBER", help="Images of one category; repeat it.", rich_help_panel=_DATASET),
    ] = None
    seed: Annotated[int | None, typer.Option(help="Decides every random value.", rich_help_panel=_DATASET)] = None
    resolution: Annotated[
        str | None,
        typer.Option(
            metavar="EDGE|WIDTHxHEIGHT", help="Size of a picture, px, such as 512 or 640x480.", rich_help_panel=_DATASET
        ),
    ] = None
    engine: Annotated[Engine | None, typer.Option(help="Render engine.", rich_help_panel=_DATASET)] = None
    quality: Annotated[
        str | None,
        typer.Option(
            metavar="draft|standard|reference|FLIP",
            help="Time against noise, or the mean FLIP to keep to, such as 0.02.",
            rich_help_panel=_DATASET,
        ),
    ] = None
    style: Annotated[
        Style | None, typer.Option(help="Which ranges everything is drawn from.", rich_help_panel=_DATASET)
    ] = None
    simulator: Annotated[Simulator | None, typer.Option(help="What lets cables fall.", rich_help_panel=_DATASET)] = None
    template: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Your own .blend template.", rich_help_panel=_DATASET)
    ] = None
    textures: Annotated[
        list[Path] | None,
        typer.Option(metavar="DIR", help="Folder of PBR textures to add; repeat it.", rich_help_panel=_DATASET),
    ] = None
    hdris: Annotated[
        list[Path] | None,
        typer.Option(metavar="DIR", help="Folder of .hdr and .exr files to add; repeat it.", rich_help_panel=_DATASET),
    ] = None
    backgrounds: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="DIR", help="Folder of photographs to stand behind far cables; repeat it.", rich_help_panel=_DATASET
        ),
    ] = None
    no_builtin_textures: Annotated[
        bool, typer.Option("--no-builtin-textures", help="Leave our surfaces out.", rich_help_panel=_DATASET)
    ] = False
    no_builtin_hdris: Annotated[
        bool, typer.Option("--no-builtin-hdris", help="Leave Blender's HDRIs out.", rich_help_panel=_DATASET)
    ] = False
    no_environments: Annotated[
        bool, typer.Option("--no-environments", help="Leave our environments out.", rich_help_panel=_DATASET)
    ] = False
    close_distributed_hdri: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="The one HDRI over a floor in its light.", rich_help_panel=_DATASET),
    ] = None

    def describe(self, **override: object) -> Description:
        """Describe the dataset, from the options and the file that they name.

        Args:
            override: keys of the description that the command itself decides.

        Raises:
            SpecError: if the options contradict each other, or a value is wrong; it names the option or key.
        """
        if self.spec_file is not None and self.spec is not None:
            raise SpecError("name one file that describes the dataset, not two")
        if self.images is not None and self.quota:
            raise SpecError("give either --images or --quota, not both")
        flags: dict[str, object] = {
            name: getattr(self, name)
            for name in ("images", "seed", "engine", "style", "simulator", "close_distributed_hdri")
            if getattr(self, name) is not None
        }
        if self.resolution is not None:
            flags["resolution"] = read_resolution(self.resolution)
        if self.quality is not None:
            flags["quality"] = read_quality(self.quality)
        if self.quota:
            flags["quotas"] = parse_quotas(self.quota)
        inputs: dict[str, object] = {}
        if self.template is not None:
            inputs["template"] = self.template
        if self.textures:
            inputs["textures"] = tuple(self.textures)
        if self.hdris:
            inputs["hdris"] = tuple(self.hdris)
        if self.backgrounds:
            inputs["backgrounds"] = tuple(self.backgrounds)
        if self.no_builtin_textures:
            inputs["builtin_textures"] = False
        if self.no_builtin_hdris:
            inputs["builtin_hdris"] = False
        if self.no_environments:
            inputs["environments"] = False
        return describe(self.spec_file or self.spec, {**flags, **override}, inputs)


def takes_dataset_options(command: Callable[..., None]) -> Callable[..., None]:
    """Let a command, whose first parameter is a `DatasetOptions`, take each of its fields as an option."""
    keyword = inspect.Parameter.KEYWORD_ONLY
    own = [parameter.replace(kind=keyword) for parameter in list(inspect.signature(command).parameters.values())[1:]]
    shared = [
        inspect.Parameter(field.name, keyword, default=field.default, annotation=field.type)
        for field in fields(DatasetOptions)
    ]

    @functools.wraps(command)
    def with_options(**values: Any) -> None:
        options = DatasetOptions(**{parameter.name: values.pop(parameter.name) for parameter in shared})
        command(options, **values)

    # Typer reads the signature and the annotations; both must be the merged ones.
    with_options.__signature__ = inspect.Signature([*shared, *own])  # type: ignore[attr-defined]  # read by inspect
    with_options.__annotations__ = {parameter.name: parameter.annotation for parameter in [*shared, *own]}
    return with_options
