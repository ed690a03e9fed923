"""Spoil a dataset's files as a disk, a copy program or a person may."""

import ctypes
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import file_path, manifest_path
from farm.spec.job import Job
from tests.chaos.farm_under_test import FarmUnderTest

_AT_FDCWD = -100  # from linux/fcntl.h
_RENAME_EXCHANGE = 2  # from linux/fs.h


def exchange_for_a_file(folder: Path) -> Callable[[], None]:
    """Replace a folder by a file, so that nothing can be written below it.

    Returns:
        A function that puts the folder back.
    """
    # The folder is kept beside the dataset, since nothing else belongs inside it.
    aside = folder.parent.parent / f"aside-{folder.name}"
    aside.write_bytes(b"")
    _exchange(folder, aside)

    def put_back() -> None:
        _exchange(folder, aside)
        aside.unlink()

    return put_back


def _exchange(one: Path, other: Path) -> None:
    # The exchange is atomic; between two steps a worker would make the folder again.
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.renameat2(_AT_FDCWD, os.fsencode(one), _AT_FDCWD, os.fsencode(other), _RENAME_EXCHANGE) != 0:
        raise OSError(ctypes.get_errno(), "renameat2 failed")


def _some_file(farm: FarmUnderTest, job_id: str, rng: np.random.Generator) -> Path:
    output = OUTPUTS[int(rng.integers(len(OUTPUTS)))]
    return farm.folder / file_path(Job.from_id(job_id), output)


def truncate(farm: FarmUnderTest, job_id: str, rng: np.random.Generator) -> None:
    """Cut off the end of one of the job's files."""
    path = _some_file(farm, job_id, rng)
    os.truncate(path, int(rng.integers(path.stat().st_size)))


def alter(farm: FarmUnderTest, job_id: str, rng: np.random.Generator) -> None:
    """Change one byte of one of the job's files; its size stays."""
    path = _some_file(farm, job_id, rng)
    with path.open("r+b") as file:
        place = int(rng.integers(path.stat().st_size))
        file.seek(place)
        old = file.read(1)[0]
        file.seek(place)
        file.write(bytes([(old + int(rng.integers(1, 256))) % 256]))


def remove_manifest(farm: FarmUnderTest, job_id: str, rng: np.random.Generator) -> None:
    """Remove the job's manifest; its files stay."""
    del rng
    (farm.folder / manifest_path(Job.from_id(job_id))).unlink()
