"""Make the same scenes in the other ways, and measure each picture's error against its reference."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.render.errors import Errors, errors
from benchmarks.render.references import References, middle
from benchmarks.render.stage_set import SettledScene, Stage
from benchmarks.whole.published import make_published
from benchmarks.whole.renderings import BLENDER, BLENDERPROC, Rendering, set_picture
from benchmarks.whole.rows import Row, Shot, Way
from benchmarks.whole.standard import settled_again, written_picture
from farm.dataset.dataset import Dataset
from farm.errors import VerificationError
from farm.spec.job import Job
from farm.spec.rendering import CyclesSettings, PictureSettings
from worker.stopwatch import Stopwatch

RENDERINGS: Mapping[Way, Rendering] = {Way.BLENDERPROC: BLENDERPROC, Way.BLENDER: BLENDER}

MOST_FLIP = 0.3
"""Most FLIP of a standard picture against its reference; above, they show different scenes."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """Makes a dataset's scenes in the other ways, and compares pictures with references.

    Attributes:
        dataset: the standard pictures.
        stage: the open renderer.
        references: pictures to compare with; None to compare none.
        folder: destination of the published method's files.
    """

    dataset: Dataset
    stage: Stage
    references: References | None
    folder: Path

    def slow_rows(self, jobs: Sequence[Job], on_image: Callable[[], None] = lambda: None) -> tuple[Row, ...]:
        """Make the scenes of some jobs in every other way, one scene after the other.

        A scene's textures are loaded before it is timed, which favours these ways: standard pictures load their own.

        Raises:
            VerificationError: if a picture doesn't fit its scene.
            FarmError: if a picture can't be made.
        """
        found: dict[Way, list[Shot]] = {way: [] for way in (Way.PUBLISHED, *RENDERINGS)}
        for job in jobs:
            settled = settled_again(self.dataset, job)
            self._warm_up(settled)
            for way, rendering in RENDERINGS.items():
                found[way].append(self._render(settled, rendering))
            found[Way.PUBLISHED].append(make_published(self.stage, self.dataset.header, job, self.folder))
            on_image()
        return tuple(Row(way, tuple(shots)) for way, shots in found.items() if shots)

    def with_errors(self, standard: Row, slow_jobs: Iterable[Job]) -> Row:
        """The standard pictures with errors, for the slow scenes and those whose references are kept.

        Raises:
            VerificationError: if a picture doesn't fit its scene.
        """
        if self.references is None:
            return standard
        needed = frozenset(slow_jobs)
        shots = []
        for shot in standard.shots:
            settled = settled_again(self.dataset, shot.job)
            if shot.job not in needed and not self.references.path(settled).exists():
                shots.append(shot)
                continue
            found = self._errors(settled, written_picture(self.dataset, shot.job))
            if found is not None and found.flip > MOST_FLIP:
                raise VerificationError(f"{shot.job.id}: a FLIP of {found.flip:.2f} against its reference")
            shots.append(replace(shot, errors=found))
        return Row(standard.way, tuple(shots))

    def _warm_up(self, settled: SettledScene) -> None:
        if self.references is not None:
            self.references.picture(settled)
        self.stage.set(settled, PictureSettings(cycles=CyclesSettings(samples=1), economy=BLENDER.settings.economy))
        self.stage.render()

    def _render(self, settled: SettledScene, rendering: Rendering) -> Shot:
        watch = Stopwatch()
        with watch.stage("realize"):
            set_picture(self.stage, settled, rendering)
        with watch.stage("render"):
            picture = self.stage.render()
        return Shot(settled.job, watch.stages_s, self._errors(settled, picture))

    def _errors(self, settled: SettledScene, picture: NDArray[np.uint8]) -> Errors | None:
        """Errors of the middle of a picture, which is what a reference covers."""
        return None if self.references is None else errors(middle(picture), self.references.picture(settled))
