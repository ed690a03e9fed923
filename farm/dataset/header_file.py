"""The file dataset.json: reading it, and telling how two headers differ."""

import functools
from collections.abc import Mapping

from pydantic import ValidationError

from farm.dataset.paths import HEADER_FILE
from farm.errors import ConflictError, SpecError
from farm.spec.header import DatasetHeader
from farm.spec.simulation import WITHDRAWN_FAULT
from farm.storage import Storage


def read_header(storage: Storage) -> DatasetHeader:
    """Read a dataset's header; one that was read before is not parsed again.

    Raises:
        FileNotFoundError: if the place holds none.
        DestinationError: if it can't be read.
        ConflictError: if it is damaged or of another version of the farm.
        SpecError: if it names a simulator that the farm no longer offers.
    """
    try:
        return _parse_header(storage.read(HEADER_FILE))
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        if first["type"] == WITHDRAWN_FAULT:
            raise SpecError(
                f"{storage.location}/{HEADER_FILE}: {where}: {first['msg']}, in a dataset in another --out"
            ) from error
        raise ConflictError(
            f"{storage.location}/{HEADER_FILE}: not readable by this version of the farm: {where}: {first['msg']}; "
            "choose another --out"
        ) from error


@functools.lru_cache(maxsize=16)  # a worker reads it for each job, as it may have been replaced
def _parse_header(content: bytes) -> DatasetHeader:
    return DatasetHeader.model_validate_json(content)


def first_difference(present: object, asked: object, where: str = "") -> str:
    """Find the first key in which two JSON values differ, as `key is 1, asked 2`; empty if they are equal."""
    if isinstance(present, Mapping) and isinstance(asked, Mapping):
        for key in [*present, *(key for key in asked if key not in present)]:
            if key == "farm_version":
                continue
            path = f"{where}.{key}" if where else str(key)
            if found := first_difference(present.get(key), asked.get(key), path):
                return found
        return ""
    if isinstance(present, list) and isinstance(asked, list):
        for index, (one, other) in enumerate(zip(present, asked, strict=False)):
            if found := first_difference(one, other, f"{where}[{index}]"):
                return found
        if len(present) != len(asked):
            return f"{where} has {len(present)} entries, asked {len(asked)}"
        return ""
    return "" if present == asked else f"{where} is {_short(present)}, asked {_short(asked)}"


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
