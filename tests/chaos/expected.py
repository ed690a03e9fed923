"""The bytes that each job's files must have, whatever happened to the farm."""

from collections.abc import Callable, Mapping
from pathlib import Path

from farm.dataset.outputs import OUTPUTS, Output, outputs_of
from farm.dataset.paths import file_path
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from tests.stand_in import stand_in_files

Expected = Callable[[Job], Mapping[Output, bytes]]


def drawn_by_stand_in(header: DatasetHeader) -> Expected:
    """The files of a stand-in renderer: noise from the job's own seed, so that no two jobs have the same."""

    def expected(job: Job) -> Mapping[Output, bytes]:
        files = stand_in_files(job, header)
        return {output: output.format.encode(files[output.role]) for output in outputs_of(header.spec)}

    return expected


def made_before(folder: Path) -> Expected:
    """What lies in the folder of a dataset of the same description."""
    return lambda job: {output: (folder / file_path(job, output)).read_bytes() for output in OUTPUTS}
