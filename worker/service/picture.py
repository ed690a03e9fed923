"""What a maker hands over for upload, and the port that workers call."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from farm.dataset.manifest import RejectedAttempt, RenderSettings, SettleFigures
from farm.scene.scene import Scene
from farm.spec.header import DatasetHeader
from farm.spec.job import Job


@dataclass(frozen=True, slots=True)
class Picture:
    """One picture with its labels and everything its manifest tells.

    Attributes:
        image: (H, W, 3) uint8 sRGB.
        mask: (H, W) uint8, 0 or 255.
        instances: (H, W) uint16, 0 for background; counted from 1, cable by cable and strand by strand of a bundle.
        timings_s: seconds per stage; the upload adds its own.
    """

    image: NDArray[np.uint8]
    mask: NDArray[np.uint8]
    instances: NDArray[np.uint16]
    scene: Scene
    settled: SettleFigures
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
