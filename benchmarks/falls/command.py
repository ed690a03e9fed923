"""`python -m benchmarks falls`: drop the first scene of each job of a style, and compare it with the gates' targets."""

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path

from benchmarks.terminal import bench_console
from farm.errors import SceneError
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, HdriRef, TemplateRef
from farm.spec.parse import parse_spec
from worker.sample.scene import sample_scene
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import Gate, measure, settled_figures
from worker.simulate.rod.fall import drop_cables
from worker.simulate.settle import find_unrest

DEFAULT_IMAGES = 180
"""Jobs whose scenes fall, unless told otherwise: 36 of each of four categories, and 18 of each of two."""


@dataclass(frozen=True, slots=True)
class Fallen:
    """One fall.

    Attributes:
        job: the job's id.
        steps: time steps.
        fall_s: seconds for which the cables fell and settled.
        fault: the reason why the scene is drawn again; None if it may be shipped.
        figures: the figure of each of gates 1 to 4, by the gate's name; none if the fall was given up.
    """

    job: str
    steps: int
    fall_s: float
    fault: str | None
    figures: dict[str, float]


def run(out: Path, *, seed: int, images: int | None, style: str) -> int:
    """Drop the scenes; print how many miss each target, and write `falls.json` into `out`.

    Args:
        out: a folder that is there.
        seed: seed of the dataset that the scenes are drawn as.
        images: number of jobs; None for the usual number.
        style: style of the scenes.
    """
    falls = list(play(_header(seed, images or DEFAULT_IMAGES, style)))
    console = bench_console()
    for line in told(falls):
        console.print(line, soft_wrap=True, markup=False, highlight=False)
    (out / "falls.json").write_text(json.dumps([asdict(fall) for fall in falls], indent=1), encoding="utf-8")
    return 0


def play(header: DatasetHeader) -> Iterator[Fallen]:
    """Let the first scene of every job fall by the rod solver."""
    for job in header.spec.jobs():
        scene = sample_scene(header, job, 0)
        try:
            shapes = drop_cables(scene, header.spec.fall.rod)
        except SceneError as error:
            yield Fallen(job.id, 0, 0.0, str(error), {})
            continue
        figures = measure(shapes)
        named = {gate.name.lower(): float(figure) for gate, figure in settled_figures(figures).items()}
        yield Fallen(job.id, shapes.steps, shapes.fall_s, find_fault(figures) or find_unrest(shapes), named)


def told(falls: list[Fallen]) -> Iterator[str]:
    """Say how many falls are drawn again and why, and how many of the others miss each target, and by how much."""
    shipped = [fall for fall in falls if fall.fault is None]
    yield f"{len(falls)} falls, {len(shipped)} shipped, {max(fall.steps for fall in falls)} steps at most"
    for reason, count in Counter(fall.fault for fall in falls if fall.fault is not None).most_common():
        yield f"drawn again: {count} x {reason}"
    for gate in (Gate.LENGTH, Gate.CABLE_PENETRATION, Gate.FLOOR_PENETRATION, Gate.SPEED_RMS, Gate.SPEED_MAX):
        figures = [fall.figures[gate.name.lower()] for fall in shipped]
        missed = sum(not gate.on_target(figure) for figure in figures)
        unit = f" {gate.value.unit}" if gate.value.unit else ""
        yield (
            f"{gate.value.name}: {missed} above the target of {gate.value.target:g}{unit}, "
            f"{max(figures, default=0.0):.3g}{unit} at most"
        )


def _header(seed: int, images: int, style: str) -> DatasetHeader:
    """Make a header whose surface and HDRI needn't exist, since nothing is rendered."""
    nothing = "0" * 64
    return DatasetHeader(
        farm_version=version("cable-farm"),
        spec=parse_spec({"images": images, "seed": seed, "style": style}, source="benchmark"),
        template=TemplateRef(path=None, sha256=nothing),
        surfaces=(BuiltinSurfaceRef(name="none", recipe_version=1),),
        hdris=(HdriRef(name="none", path=None, sha256=nothing, dark=False),),
    )
