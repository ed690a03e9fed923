"""The id of a dataset's place: tells its folder from any other that holds the same dataset.

Datasets of one name and description may lie in several stores whose farms share one Redis. Their runs must not meet,
and a path can't tell them apart, as each machine may have a store at another one. So a submission leaves a random id in
the folder. It decides nothing in a picture.
"""

import re
import secrets
import time
from pathlib import Path

from farm.dataset.dataset import Dataset
from farm.dataset.paths import PLACE_FILE
from farm.errors import DestinationError
from farm.machine import machine_name
from farm.storage import Storage, open_storage

_ID = re.compile(rb"[0-9a-f]{16}\n")

_GLOBAL_SCHEMES = frozenset({"s3", "s3a", "gs", "gcs", "az", "abfs", "abfss", "r2", "oci"})
"""Schemes of URLs that start with a bucket's name: two such URLs with different paths are different places."""

_PATIENCE_S = 2.0
"""Seconds within which the writer of an id that is half written must end it."""


def read_place(storage: Storage) -> str:
    """Read the id of the place that a storage is; empty if it has none, or one that can't be read.

    Raises:
        DestinationError: if the folder can't be read.
    """
    try:
        content = storage.read(PLACE_FILE)
    except FileNotFoundError:
        return ""
    return content.decode().strip() if _ID.fullmatch(content) else ""


def claim_place(storage: Storage) -> str:
    """Read the id of a place, after giving it one if it has none. Of several that do so at once, all get the same.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    give_up_s = time.monotonic() + _PATIENCE_S
    while not (found := read_place(storage)):
        if storage.create(PLACE_FILE, _new_content()):
            continue
        if time.monotonic() >= give_up_s:
            # Whoever began to write it was killed.
            storage.write(PLACE_FILE, _new_content())
        time.sleep(0.05)
    return found


def keep_place(storage: Storage, place: str) -> None:
    """Write the id of a run's place again if it was lost, as by a move of `folder/*`: workers go by it.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    if place and not read_place(storage):
        storage.create(PLACE_FILE, f"{place}\n".encode())


def renew_place(storage: Storage) -> str:
    """Give a place another id: the present one came with a copy of the folder.

    Raises:
        DestinationError: if the folder can't be written.
    """
    storage.write(PLACE_FILE, _new_content())
    return read_place(storage)


def new_id() -> str:
    """Draw an id that no place has."""
    return secrets.token_hex(8)


def _new_content() -> bytes:
    return f"{new_id()}\n".encode()


def locate(dataset: Dataset) -> str:
    """Describe where a dataset lies, for others on the same machine: the URL, or `MACHINE:PATH`."""
    location = dataset.storage.location
    return location if "://" in location else f"{machine_name()}:{location}"


def is_elsewhere(located: str, dataset: Dataset) -> bool:
    """Whether a description by `locate` is certainly of another place than the dataset's, though both have one id.

    This shows that one is a copy of the other. Two folders can be compared by the machine that has both, and two
    buckets by their names; in other cases nothing is certain, and this is False.

    Args:
        located: description of the other place; empty if there is none.
        dataset: dataset whose place has the same id.
    """
    here = dataset.storage.location
    if not located or located == locate(dataset):
        return False
    if "://" in here or "://" in located:
        schemes = {here.partition("://")[0], located.partition("://")[0]}
        return "://" in here and "://" in located and len(schemes) == 1 and schemes <= _GLOBAL_SCHEMES
    machine, _, path = located.partition(":")
    try:
        return (
            machine == machine_name()
            and Path(path).exists()
            and not Path(path).samefile(here)
            and read_place(open_storage(path)) == read_place(dataset.storage)
        )
    except (OSError, DestinationError):
        return False
