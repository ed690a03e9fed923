"""Keeps the pictures of two releases apart: the same description may look otherwise in another release."""

from farm import __version__
from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.quarantine import Quarantine
from farm.errors import ConflictError
from farm.spec.job import Job
from farm.spec.job_set import JobSet


def refuse_to_mix(dataset: Dataset) -> None:
    """Refuse to add pictures to a dataset of another release; one in which nothing is missing is no matter.

    Raises:
        ConflictError: if another release began it, and pictures are missing.
        DestinationError: if its folder can't be read.
    """
    if dataset.header.farm_version == __version__:
        return
    given_up = JobSet(dataset.header.spec.quotas)
    for job_id in Quarantine(dataset).look():
        given_up.add(Job.from_id(job_id))
    if len(Completion(dataset).audit().others() - given_up):
        place = dataset.storage.location
        raise ConflictError(
            f"{place}: begun by cable-farm {dataset.header.farm_version}, whose pictures may differ from those of this "
            f"release, {__version__}; finish it with that release, choose another --out, or mix the two: "
            f"farm run --continue --out {place}, or farm submit --continue --out {place}"
        )
