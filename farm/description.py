"""From a TOML file and flags to a dataset's description and inputs. A flag overrides the file's key."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from farm.catalogue import Inputs
from farm.category import Category
from farm.errors import SpecError
from farm.spec import DatasetSpec, parse_spec, read_toml

_MOST_DIGITS = 12
"""More than any quota has; Python refuses to read thousands."""

_FOLDERS = ("textures", "hdris", "backgrounds")
"""Keys that list folders."""


@dataclass(frozen=True, slots=True)
class Description:
    """What to make, and of what."""

    spec: DatasetSpec
    inputs: Inputs


def parse_quotas(pairs: Sequence[str]) -> dict[str, int]:
    """Read `category=number` pairs.

    Raises:
        SpecError: if one is malformed, names no category, or a category twice.
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
        file: keys of `DatasetSpec`, `images`, and those of `Inputs`; its paths are relative to its own folder.
        flags: keys of `DatasetSpec` and `images` that were given, overriding the file's.
        inputs: keys of `Inputs` that were given, overriding the file's.

    Raises:
        SpecError: with the key, what was wrong with it, and where.
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
