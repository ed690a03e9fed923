"""The file dataset.json: writing and reading it, and a dataset's identity."""

import functools
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass

import pydantic_core
from pydantic import ValidationError

from farm import __version__
from farm.dataset.paths import HEADER_FILE
from farm.errors import ConflictError, SpecError
from farm.spec.header import DatasetHeader
from farm.spec.simulation import WITHDRAWN_FAULT
from farm.storage import Storage

_VERSION_KEY = "farm_version"
_NO_VERSION = "an unknown release"


@dataclass(frozen=True, slots=True)
class WrittenHeader:
    """A header as it stands in `dataset.json`.

    Attributes:
        header: the header, with the defaults of this release where the file lacks a key.
        identity: SHA-256 by which manifests and messages name the dataset.
        written: the file's values as they are, without defaults.
    """

    header: DatasetHeader
    identity: str
    written: Mapping[str, object]


def header_content(header: DatasetHeader) -> bytes:
    """Make the content of `dataset.json`."""
    return header.model_dump_json(indent=1).encode() + b"\n"


def read_header(storage: Storage) -> WrittenHeader:
    """Read a dataset's header; one that was read before is not parsed again.

    Raises:
        FileNotFoundError: if the place holds none.
        DestinationError: if it can't be read.
        ConflictError: if it is damaged or of another version of the farm.
        SpecError: if it names a simulator that the farm no longer offers.
    """
    try:
        content = storage.read(HEADER_FILE)
        return parse_header(content)
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        if first["type"] == WITHDRAWN_FAULT:
            raise SpecError(
                f"{storage.location}/{HEADER_FILE}: {where}: {first['msg']}, in a dataset in another --out"
            ) from error
        raise ConflictError(
            f"{storage.location}/{HEADER_FILE}: written by {_release(content)}, not readable by cable-farm "
            f"{__version__}: {where}: {first['msg']}; use that release, or choose another --out"
        ) from error


@functools.lru_cache(maxsize=16)  # a worker reads it for each job, as it may have been replaced
def parse_header(content: bytes) -> WrittenHeader:
    """Parse the content of `dataset.json`.

    The identity is taken from the values that the file holds. A release that adds keys with defaults reads the same
    identity from the datasets of earlier ones.

    Raises:
        ValidationError: if it is no header that this release can read.
    """
    header = DatasetHeader.model_validate_json(content)
    written = pydantic_core.from_json(content)
    identity = hashlib.sha256(pydantic_core.to_json(_without_version(written))).hexdigest()
    return WrittenHeader(header, identity, written)


def _without_version(written: Mapping[str, object]) -> dict[str, object]:
    return {key: value for key, value in written.items() if key != _VERSION_KEY}


def _release(content: bytes) -> str:
    """Name the release that wrote a header which this one can't read."""
    try:
        written = pydantic_core.from_json(content)
    except ValueError:
        return _NO_VERSION
    version = written.get(_VERSION_KEY) if isinstance(written, Mapping) else None
    return f"cable-farm {version[:40]!a}" if isinstance(version, str) else _NO_VERSION
