"""The bytes that each job's files must have, whatever happened to the farm."""

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from farm.dataset.paths import FileRole, file_path
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from tests.stand_in import stand_in_pixels
from worker.service.upload import encode_png

Expected = Callable[[Job], Mapping[FileRole, bytes]]


def drawn_by_stand_in(header: DatasetHeader) -> Expected:
    """The files of a stand-in renderer: noise from the job's own seed, so that no two jobs have the same."""

    def expected(job: Job) -> Mapping[FileRole, bytes]:
        image, instances = stand_in_pixels(job, header)
        mask = np.where(instances > 0, 255, 0).astype(np.uint8)
        return {
            FileRole.IMAGE: encode_png(image),
            FileRole.MASK: encode_png(mask),
            FileRole.INSTANCES: encode_png(instances),
        }

    return expected


def made_before(folder: Path) -> Expected:
    """The files in the folder of a finished dataset with the same description."""
    return lambda job: {role: (folder / file_path(job, role)).read_bytes() for role in FileRole}
