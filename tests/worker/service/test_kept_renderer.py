"""The renderer that a process keeps open."""

import errno
import os
from pathlib import Path

import pytest

from farm.errors import (
    AssetError,
    DestinationError,
    FarmError,
    MachineError,
    RenderError,
    SceneError,
    TemplateError,
    UnfitWorkerError,
)
from farm.run.worker_settings import RendererSettings
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.kept_renderer import KeptRenderer
from worker.service.picture import Picture, Renderer

JOB = Job.from_id("far-000001")
SETTINGS = RendererSettings(threads=3, assets=Path("surfaces"))


class Opener:
    """Opens stand-ins and notes for what."""

    def __init__(self) -> None:
        self.opened: list[tuple[DatasetHeader, RendererSettings]] = []

    def __call__(self, header: DatasetHeader, settings: RendererSettings) -> Renderer:
        """Open one."""
        self.opened.append((header, settings))
        return StandInRenderer()


def test_one_renderer_serves_all_jobs_of_a_dataset(header: DatasetHeader) -> None:
    """It is opened once, with the settings it was given."""
    opener = Opener()
    renderer = KeptRenderer(opener, SETTINGS)
    for job in header.spec.jobs():
        renderer.make(job, header)
    assert opener.opened == [(header, SETTINGS)]


def test_another_dataset_gets_another_renderer(header: DatasetHeader) -> None:
    """The renderer of the last dataset is kept, no more than that."""
    opener, other = Opener(), stand_in_header(seed=1)
    renderer = KeptRenderer(opener, SETTINGS)
    for each in (header, other, other, header):
        renderer.make(JOB, each)
    assert [opened for opened, _ in opener.opened] == [header, other, header]


@pytest.mark.parametrize(
    "fault", [AssetError("torn"), MachineError("no GPU"), TemplateError("bent"), RenderError("dark")]
)
def test_a_renderer_that_cannot_be_opened_makes_the_worker_unfit(header: DatasetHeader, fault: FarmError) -> None:
    """Whatever the fault, which keeps its kind and words."""

    def refuse(*_: object) -> Renderer:
        raise fault

    with pytest.raises(UnfitWorkerError, match=str(fault)) as unfit:
        KeptRenderer(refuse, SETTINGS).make(JOB, header)
    assert type(unfit.value.as_fault()) is type(fault)


@pytest.mark.parametrize(
    ("kind", "told"), [("asset", UnfitWorkerError), ("permanent", SceneError), ("defect", RenderError)]
)
def test_what_fails_amid_a_picture(
    header: DatasetHeader, monkeypatch: pytest.MonkeyPatch, kind: str, told: type[FarmError]
) -> None:
    """A fault of the machine is the worker's, one of the scene the job's, and a defect may pass."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}={kind}")
    with pytest.raises(told) as failed:
        KeptRenderer(Opener(), SETTINGS).make(JOB, header)
    assert type(failed.value) is told


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EROFS])
@pytest.mark.parametrize("opening", [True, False])
def test_a_full_disk_of_this_machine(header: DatasetHeader, number: int, opening: bool) -> None:
    """A full folder for short-lived or kept files is no fault of the job: it is named, and the worker waits."""

    class FullRenderer(StandInRenderer):
        def make(self, job: Job, header: DatasetHeader) -> Picture:
            del job, header
            raise OSError(number, os.strerror(number), "/cache/compiled/x")

    def full(*_: object) -> Renderer:
        if opening:
            FullRenderer().make(JOB, header)
        return FullRenderer()

    with pytest.raises(DestinationError, match=f"/cache/compiled/x: can't write: {os.strerror(number)}; make room"):
        KeptRenderer(full, SETTINGS).make(JOB, header)
