"""Writing a made picture into its dataset: its files in the order of the table of outputs, and the manifest last."""

import time
from typing import Protocol

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Manifest, file_record
from farm.dataset.outputs import find_faults, outputs_of
from farm.dataset.paths import file_path, manifest_path
from farm.errors import BrokerError, RenderError
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.job import Job
from worker.service.lease import LeaseLostError
from worker.service.picture import Picture


def _check(made: Picture, spec: DatasetSpec) -> None:
    outputs = outputs_of(spec)
    wanted = [output.role for output in outputs]
    if made.files.keys() != set(wanted):
        raise RenderError(f"made {', '.join(made.files)}; the dataset has {', '.join(wanted)}")
    for output, fault in find_faults(outputs, made.files, spec.resolution):
        raise RenderError(f"{output.role}: {fault}")


class Guard(Protocol):
    """Tells whether the job may still be written; see `worker.service.lease.Lease`."""

    def renew(self) -> None:
        """Ask the ledger; raises LeaseLostError or BrokerError."""
        ...

    def check(self) -> None:
        """Go by the last answer, without asking; raises LeaseLostError."""
        ...


class Unguarded:
    """The guard of a writer that has the dataset to itself."""

    def renew(self) -> None:
        """Do nothing: there is no ledger to ask."""

    def check(self) -> None:
        """Do nothing: no other process writes the job."""


def upload(made: Picture, job: Job, dataset: Dataset, guard: Guard | None = None) -> Manifest:
    """Write the files, then the manifest that vouches for them.

    Returns:
        The manifest; its timings have the seconds of this stage as `write`.

    Raises:
        RenderError: if a file's content is not what its output must have, or the contents don't fit each other.
        DestinationError: if a file can't be written.
        LeaseLostError: if the guard finds that another may be writing; then what is in place is whole, or has no
            manifest.
        BrokerError: if the guard can't find out; then, too, what is in place is whole, or has no manifest.
    """
    _check(made, dataset.header.spec)
    guard = guard or Unguarded()
    guard.renew()
    try:
        return _write(made, job, dataset, guard)
    except (LeaseLostError, BrokerError):
        # The process may have been stopped between a check and its write, which then may have met another's files.
        if not is_done(dataset, job):
            dataset.storage.remove(manifest_path(job))
        raise


def _write(made: Picture, job: Job, dataset: Dataset, guard: Guard) -> Manifest:
    start = time.perf_counter()
    files = {}
    for output in outputs_of(dataset.header.spec):
        content = output.format.encode(made.files[output.role])
        path = file_path(job, output)
        guard.check()
        dataset.storage.write(path, content)
        files[output.folder] = file_record(path, content)
    manifest = Manifest(
        dataset=dataset.name,
        spec_sha256=dataset.identity,
        job_id=job.id,
        seed=dataset.header.spec.seed,
        scene=made.scene,
        settled=made.settled,
        rejected=made.rejected,
        render=made.render,
        timings_s={**made.timings_s, "write": time.perf_counter() - start},
        versions=made.versions,
        files=files,
    )
    guard.renew()
    dataset.storage.write(manifest_path(job), manifest.model_dump_json(indent=1).encode() + b"\n")
    guard.check()
    return manifest
