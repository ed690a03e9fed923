"""`python -m benchmarks examples`: contact sheets of every surface, environment and kind of cable."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.progress import track

from benchmarks.examples.groups import GROUPS, Example
from benchmarks.examples.sheet import draw_sheet, examples_a_row
from benchmarks.terminal import bench_console, blender_writes_to
from farm.run.worker_settings import DeviceChoice, RendererSettings
from farm.spec.job import Job
from worker.blender.renderer import open_renderer

DEFAULT_EACH = 4
"""Pictures of each example unless the command line says otherwise."""

RESOLUTION = 320
"""Pixels along an edge of a rendered picture; a sheet shows it smaller."""

_PAGE = 12
"""Rows of pictures on a sheet."""


def run(out: Path, *, seed: int, each: int | None, groups: Sequence[str], only: Sequence[str]) -> int:
    """Render the examples and write `examples-<group>-<page>.jpg` into `out`.

    Args:
        out: an existing folder.
        seed: seed of the scenes.
        each: number of pictures of each example; `DEFAULT_EACH` if None or 0.
        groups: names of the groups in `GROUPS` to make; all if empty.
        only: labels of the examples to make; all if empty.

    Raises:
        FarmError: if a picture can't be made.
    """
    console = bench_console()
    each = each or DEFAULT_EACH
    page_of = _PAGE * examples_a_row(each)
    for group in groups or GROUPS:
        chosen = [example for example in GROUPS[group](seed) if not only or example.label in only]
        rows: list[tuple[str, list[NDArray[np.uint8]]]] = []
        for example in track(chosen, group, console=console, transient=True):
            with blender_writes_to(out / "examples.log"):
                rows.append((example.label, list(_pictures(example, each))))
        for page, start in enumerate(range(0, len(rows), page_of), start=1):
            path = out / f"examples-{group}-{page}.jpg"
            path.write_bytes(draw_sheet(rows[start : start + page_of]))
            console.print(f"{path}")
    return 0


def _pictures(example: Example, each: int) -> Iterator[NDArray[np.uint8]]:
    header = example.header.model_copy(
        update={"spec": example.header.spec.model_copy(update={"resolution": RESOLUTION})}
    )
    renderer = open_renderer(header, RendererSettings(device=DeviceChoice.CPU))
    for index in range(each):
        yield renderer.make(Job(category=example.category, index=index), header).files["image"]
