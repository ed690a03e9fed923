"""The description of a dataset: what a user writes in TOML or as flags, fully resolved."""

import tomllib
from collections.abc import Iterator, Mapping
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, Literal

import pydantic_core
from pydantic import Field, ValidationError, model_validator

from farm.category import Category
from farm.errors import SpecError
from farm.fall import Fall, Simulator
from farm.job import Job
from farm.model import Model
from farm.quality import Preset, Quality, settings_for
from farm.quotas import split_total
from farm.ranges import Ranges
from farm.styles import Style, merge_ranges

Quota = Annotated[int, Field(ge=0, le=10**7)]


DEFAULT_STYLE = Style.WIDE


class Engine(StrEnum):
    """Blender's render engine."""

    CYCLES = "cycles"
    EEVEE = "eevee"


class DatasetSpec(Model):
    """A dataset: how many images of which category, from which seed, made how.

    `quotas` holds all six categories; `parse_spec` fills it in from a total, and `ranges` from the style.
    """

    version: Literal[1] = 1
    seed: Annotated[int, Field(ge=0, lt=2**64)] = 0
    quotas: Mapping[Category, Quota]
    resolution: Annotated[int, Field(ge=32, le=8192)] = 512
    engine: Engine = Engine.CYCLES
    quality: Quality = Preset.STANDARD
    close_distributed_hdri: str | None = None
    style: Style = Style.PUBLISHED
    simulator: Simulator = Simulator.ROD
    fall: Fall = Fall()
    ranges: Ranges = Ranges()

    @model_validator(mode="after")
    def _asks_for_something(self) -> "DatasetSpec":
        if self.total == 0:
            raise ValueError("the quotas add up to zero images; ask for at least one")
        return self

    @model_validator(mode="after")
    def _can_be_rendered_so_well(self) -> "DatasetSpec":
        if isinstance(self.quality, float) and self.engine is not Engine.CYCLES:
            raise ValueError("quality as a number is measured for engine 'cycles' alone; name a preset")
        if self.engine is Engine.CYCLES:
            for category in (category for category, quota in self.quotas.items() if quota):
                settings_for(self.quality, category)  # raises if there are none
        return self

    @property
    def total(self) -> int:
        """Images in all."""
        return sum(self.quotas.values())

    def jobs(self) -> Iterator[Job]:
        """Every job of the dataset, lazily, the categories in proportion.

        Jobs of all categories are interleaved so that a dataset stopped half way has all of them.
        """
        for numerator in range(max(self.quotas.values())):
            for category, quota in self.quotas.items():
                if numerator < quota:
                    yield Job.model_construct(category=category, index=numerator)


def _resolve_quotas(data: Mapping[str, object]) -> dict[str, object]:
    resolved = dict(data)
    images, quotas = resolved.pop("images", None), resolved.get("quotas")
    if images is not None and quotas is not None:
        raise SpecError("give either images or quotas, not both")
    if images is not None:
        if not isinstance(images, int) or isinstance(images, bool) or images < 0:
            raise SpecError(f"images: expected a whole number, 0 or more, not {images!r}")
        quotas = {str(category): count for category, count in split_total(images).items()}
    if isinstance(quotas, Mapping):
        unknown = sorted({str(key) for key in quotas} - set(Category))
        if unknown:
            raise SpecError(f"quotas: unknown category {unknown[0]!r}; there are {', '.join(Category)}")
        quotas = {str(category): quotas.get(category, 0) for category in Category}
    return resolved if quotas is None else resolved | {"quotas": quotas}


def _resolve_ranges(data: Mapping[str, object]) -> dict[str, object]:
    style, overrides = data.get("style", DEFAULT_STYLE), data.get("ranges", {})
    if not isinstance(style, str) or style not in set(Style):
        raise SpecError(f"style: expected one of {', '.join(Style)}, not {style!r}")
    if not isinstance(overrides, Mapping):
        raise SpecError(f"ranges: expected a table, not {overrides!r}")
    return {**data, "style": style, "ranges": merge_ranges(Style(style), overrides)}


def parse_spec(data: Mapping[str, object], *, source: str) -> DatasetSpec:
    """Validate a description; a total `images` is split over the categories as published, 2:2:1:1:2:2.

    Args:
        data: JSON-like values, with either `images` or `quotas`.
        source: where they come from, named in the error.

    Raises:
        SpecError: with the key, what was wrong with it, and where.
    """
    try:
        return DatasetSpec.model_validate_json(pydantic_core.to_json(_resolve_ranges(_resolve_quotas(data))))
    except ValidationError as error:
        raise SpecError(f"{source}: {_describe(error)}") from error
    except (SpecError, pydantic_core.PydanticSerializationError) as error:
        raise SpecError(f"{source}: {error}") from error


def read_toml(path: Path) -> dict[str, Any]:
    """Read a TOML file.

    Raises:
        SpecError: if it can't be read or is no TOML.
    """
    try:
        with path.open("rb") as file:
            return tomllib.load(file)
    except OSError as error:
        raise SpecError(f"{path}: can't read the dataset's description: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        # Besides those of its own, tomllib raises what Python does over numbers of thousands of digits and deep tables.
        raise SpecError(f"{path}: not valid TOML: {error}") from error


def _describe(error: ValidationError) -> str:
    first = error.errors(include_url=False, include_context=False)[0]
    where = ".".join(str(part) for part in first["loc"])
    message = first["msg"].removeprefix("Value error, ")
    if first["type"] == "extra_forbidden":
        message = "unknown key; the README tells where all keys are listed"
    if first["type"] == "missing" and where == "quotas":
        message = "give the number of images: images, or a [quotas] table"
    more = f" (and {error.error_count() - 1} more)" if error.error_count() > 1 else ""
    return f"{where}: {message}{more}" if where else f"{message}{more}"
