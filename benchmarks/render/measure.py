"""Render scenes with variants, and measure seconds and errors."""

import hashlib
import time
from collections import defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path

from benchmarks.render.errors import errors
from benchmarks.render.references import References, middle
from benchmarks.render.rows import Row, Shot
from benchmarks.render.stage_set import SettledScene, Stage
from benchmarks.render.variants import Variant
from benchmarks.terminal import blender_writes_to
from farm.spec.category import Category


class Measurement:
    """Renders scenes and keeps the measurements.

    Args:
        stage: the open renderer.
        references: pictures to compare with.
        log_file: destination of Blender's output.
    """

    def __init__(self, stage: Stage, references: References, log_file: Path) -> None:
        self._stage, self._references, self._log_file = stage, references, log_file
        self._shots: dict[tuple[Variant, Category], list[Shot]] = defaultdict(list)

    def measure(self, settled: SettledScene, variants: Iterable[Variant]) -> None:
        """Render a scene with all variants in succession, so that a drift in the machine's speed affects them alike."""
        with blender_writes_to(self._log_file):
            reference = self._references.picture(settled)
            for variant in variants:
                start = time.perf_counter()
                self._stage.set(settled, variant.settings)
                built = time.perf_counter()
                picture = self._stage.render()
                rendered = time.perf_counter()
                shot = Shot(
                    scene=settled.job.id,
                    build_s=built - start,
                    render_s=rendered - built,
                    errors=errors(middle(picture), reference),
                    sha256=hashlib.sha256(picture.tobytes()).hexdigest(),
                )
                self._shots[variant, settled.job.category].append(shot)

    def rows(self) -> Sequence[Row]:
        """The measurements so far."""
        return [Row(variant, category, tuple(shots)) for (variant, category), shots in self._shots.items()]
