"""Reads a dataset's description and inputs from a TOML file and flags. A flag overrides the file's key."""

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pydantic_core
from pydantic import ValidationError

from farm.errors import SpecError
from farm.spec.category import Category
from farm.spec.dataset_spec import DEFAULT_STYLE, DatasetSpec
from farm.spec.make_header import Inputs
from farm.spec.quotas import split_total
from farm.spec.simulation import Simulator
from farm.spec.styles import RANGES_OF, Style, merge_ranges
from farm.spec.workable import check_workable

_MOST_DIGITS = 12
"""Digits that a quota may have: more than any quota needs, and few enough for Python, which refuses thousands."""

_FOLDERS = ("textures", "hdris", "backgrounds")
"""Keys of `Inputs` that hold a list of folders."""


@dataclass(frozen=True, slots=True)
class Description:
    """A dataset as a user asks for it.

    Attributes:
        spec: description of the dataset.
        inputs: files that the dataset uses.
    """

    spec: DatasetSpec
    inputs: Inputs


def parse_quotas(pairs: Sequence[str]) -> dict[str, int]:
    """Read pairs such as `far=100`.

    Args:
        pairs: pairs of a category and a number, joined by `=`.

    Returns:
        The number for each category that is named.

    Raises:
        SpecError: if a pair is malformed, or names an unknown category or one that another pair names.
    """
    quotas: dict[str, int] = {}
    for pair in pairs:
        name, _, number = pair.partition("=")
        if name not in set(Category):
            raise SpecError(f"--quota {pair}: unknown category '{name}'; there are {', '.join(Category)}")
        if not number.isascii() or not number.isdigit() or len(number) > _MOST_DIGITS:
            raise SpecError(f"--quota {pair}: expected CATEGORY=NUMBER with a whole number, 0 or more")
        if name in quotas:
            raise SpecError(f"--quota {pair}: {name} has a quota already")
        quotas[name] = int(number)
    return quotas


def describe(file: Path | None, flags: Mapping[str, object], inputs: Mapping[str, object]) -> Description:
    """Merge a TOML file with flags.

    Args:
        file: TOML file with keys of `DatasetSpec` and `Inputs`, and `images`; its paths are relative to its folder.
        flags: given keys of `DatasetSpec`, and `images`, which override the file's.
        inputs: given keys of `Inputs`, which override the file's.

    Raises:
        SpecError: if a key or value is wrong; the text names the key, the fault and the source.
    """
    data: dict[str, Any] = {} if file is None else read_toml(file)
    folder = Path() if file is None else file.parent
    from_file = {key: data.pop(key) for key in Inputs.__dataclass_fields__ if key in data}
    source = "flags" if file is None else str(file)
    merged_inputs = {**_read_inputs(from_file, folder, source), **inputs}
    if "images" in flags or "quotas" in flags:
        data.pop("images", None)
        data.pop("quotas", None)
    return Description(
        spec=parse_spec({**data, **flags}, source=source if not flags or file is None else f"{source} and flags"),
        inputs=Inputs(**merged_inputs),
    )


def _read_inputs(data: Mapping[str, object], folder: Path, source: str) -> dict[str, Any]:
    inputs: dict[str, Any] = {}
    for key, value in data.items():
        if key == "template" and isinstance(value, str):
            inputs[key] = folder / value
        elif key in _FOLDERS and isinstance(value, list) and all(isinstance(entry, str) for entry in value):
            inputs[key] = tuple(folder / entry for entry in value)
        elif key in {"builtin_textures", "builtin_hdris", "environments"} and isinstance(value, bool):
            inputs[key] = value
        else:
            expected = {"template": "a path", **dict.fromkeys(_FOLDERS, "a list of paths")}
            raise SpecError(
                f"{source}: {key}: expected {expected.get(key, 'true or false')}, not {type(value).__name__}"
            )
    return inputs


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
    simulator = Simulator.CLOTH if data.get("simulator") == Simulator.CLOTH else Simulator.ROD
    return {**data, "style": style, "ranges": merge_ranges(Style(style), overrides, simulator)}


def parse_spec(data: Mapping[str, object], *, source: str) -> DatasetSpec:
    """Validate a description; a total `images` is split over the categories as published, 2:2:1:1:2:2.

    Args:
        data: values as in JSON, with either `images` or `quotas`.
        source: name of the source, such as a file, for the error's text.

    Raises:
        SpecError: if a key or value is wrong; the text names the key, the fault and the source.
    """
    try:
        spec = DatasetSpec.model_validate_json(pydantic_core.to_json(_resolve_ranges(_resolve_quotas(data))))
        check_workable(spec)
    except ValidationError as error:
        raise SpecError(f"{source}: {_describe(error)}") from error
    except (SpecError, pydantic_core.PydanticSerializationError) as error:
        raise SpecError(f"{source}: {error}") from error
    return spec


def read_toml(path: Path) -> dict[str, Any]:
    """Read a TOML file.

    Raises:
        SpecError: if it can't be read or is not valid TOML.
    """
    try:
        with path.open("rb") as file:
            return tomllib.load(file)
    except OSError as error:
        raise SpecError(f"{path}: can't read the dataset's description: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        # Beside its own errors, tomllib raises Python's for numbers of thousands of digits and for deep tables.
        raise SpecError(f"{path}: not valid TOML: {error}") from error


def _tables_with(key: str) -> list[str]:
    """List the tables of ranges that have a key, such as `ranges.cable`."""

    def search(tables: Mapping[str, object], place: str) -> Iterator[str]:
        for name, value in tables.items():
            if name == key:
                yield place
            if isinstance(value, Mapping):
                yield from search(value, f"{place}.{name}")

    return list(search(RANGES_OF[DEFAULT_STYLE].model_dump(), "ranges"))


def _describe(error: ValidationError) -> str:
    first = error.errors(include_url=False, include_context=False)[0]
    where = ".".join(str(part) for part in first["loc"])
    message = first["msg"].removeprefix("Value error, ")
    if first["type"] == "extra_forbidden":
        tables = _tables_with(str(first["loc"][-1]))
        place = f"it belongs to [{tables[0]}]" if len(tables) == 1 else "the README tells where all keys are listed"
        message = f"unknown key; {place}"
    if first["type"] == "missing" and where == "quotas":
        message = "give the number of images: images, or a [quotas] table"
    more = f" (and {error.error_count() - 1} more)" if error.error_count() > 1 else ""
    return f"{where}: {message}{more}" if where else f"{message}{more}"
