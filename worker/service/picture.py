"""The picture that a renderer hands over for upload, and the port by which workers call a renderer."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from farm.dataset.manifest import RejectedAttempt, RenderSettings, SettleFigures
from farm.scene.scene import Scene
from farm.spec.header import DatasetHeader
from farm.spec.job import Job


@dataclass(frozen=True, slots=True)
class Picture:
    """One picture with its labels and everything its manifest tells.

    Attributes:
        files: content of every file by its output's role; `farm.dataset.outputs` says what each is.
        settled: measurements of the settled cables; None for a picture without cables.
        timings_s: seconds per stage; the upload adds its own.
    """

    files: Mapping[str, Any]
    scene: Scene
    settled: SettleFigures | None
    rejected: tuple[RejectedAttempt, ...]
    render: RenderSettings
    timings_s: Mapping[str, float]
    versions: Mapping[str, str]


class Renderer(Protocol):
    """Makes the picture of a job; the one of `worker.blender` holds an open Blender template."""

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Make one picture.

        Raises:
            FarmError: of the kind that tells whether trying again can help.
        """
        ...
