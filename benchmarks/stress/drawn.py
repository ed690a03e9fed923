"""Drawn scenes: the first attempts of jobs fall as a worker lets them fall, and are judged as a worker judges them."""

import time
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version

import numpy as np

from benchmarks.physics.gates import StressFault, stress_fault
from benchmarks.stress.holds import Holding, held_by
from benchmarks.stress.kinds import KINDS, Draw
from benchmarks.stress.watched import WatchedSimulation, watching
from farm.dataset.manifest import SettleFigures
from farm.errors import SceneError
from farm.scene.physics import GRAVITY_M_S2
from farm.scene.scene import Scene
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, HdriRef, TemplateRef
from farm.spec.job import Job
from farm.spec.parse import parse_spec
from worker.sample.scene import sample_scene
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import measure
from worker.simulate.rod.fall import drop_cables
from worker.simulate.rod.simulation import DivergedError, TooManyStepsError
from worker.simulate.settle import find_unrest
from worker.simulate.shapes import CableShapes


@dataclass(frozen=True, slots=True)
class DrawnResult:
    """The result of a drawn scene's fall.

    Attributes:
        draw: the scene.
        holds: what it holds.
        fault: reason why the run failed; None if it did not.
        again: the worker's reason to draw the scene again; None if it ships this one.
        figures: figures of gates 1 to 4; None if the fall was given up, or a cable is far away.
        passes: number of passages of a rod through another or itself, away from all ends, that stand.
        end_slips: number of such passages close to an end.
        passages: all these passages in words.
        undone: number of passages that were led back.
        fall_s: simulated time.
        steps: number of time steps.
        cpu_s: processor's time for the fall and the watch; it decides nothing.
    """

    draw: Draw
    holds: tuple[Holding, ...]
    fault: StressFault | None
    again: str | None
    figures: SettleFigures | None
    passes: int
    end_slips: int
    passages: tuple[str, ...]
    undone: int
    fall_s: float
    steps: int
    cpu_s: float


def play_drawn(draw: Draw) -> DrawnResult:
    """Let a drawn scene fall until it rests, or is given up."""
    header = header_of(draw.kind, draw.seed)
    scene = sample_scene(header, Job.from_id(draw.job), 0)
    reach, began = reach_m(scene), time.process_time()
    shapes, error = None, None
    # Cables that have flown apart may overflow; finding that out is the purpose of the test.
    with watching(reach) as made, np.errstate(over="ignore", invalid="ignore"):
        try:
            shapes = drop_cables(scene, header.spec.fall.rod)
        except SceneError as refused:
            error = refused
    cpu_s = time.process_time() - began
    fault, again, figures = _judge(shapes, error, made, reach)
    return DrawnResult(
        draw=draw,
        holds=held_by(scene),
        fault=fault,
        again=again,
        figures=figures,
        passes=sum(simulation.watch.passes for simulation in made),
        end_slips=sum(simulation.watch.end_slips for simulation in made),
        passages=tuple(each for simulation in made for each in simulation.describe_passages()),
        undone=sum(simulation.watch.undone for simulation in made),
        fall_s=sum(simulation.time_s for simulation in made),
        steps=sum(simulation.steps for simulation in made),
        cpu_s=cpu_s,
    )


def _judge(
    shapes: CableShapes | None, error: SceneError | None, made: list[WatchedSimulation], reach: float
) -> tuple[StressFault | None, str | None, SettleFigures | None]:
    """The stress test's fault, the worker's reason to draw again, and the figures."""
    passes = sum(simulation.watch.passes for simulation in made)
    if shapes is None:
        return _fault_of(error, passes), str(error), None
    fault = stress_fault(shapes, reach_m=reach, passes=passes)
    if fault in {StressFault.NOT_FINITE, StressFault.ESCAPED}:
        return fault, fault.value, None
    figures = measure(shapes)
    again = find_fault(figures) or find_unrest(shapes)
    if fault is None and not shapes.rested:
        fault = StressFault.NOT_AT_REST
    return fault, again, figures


def _fault_of(error: SceneError | None, passes: int) -> StressFault | None:
    """The fault of a fall that was given up; None if it is the scene that could not be laid out."""
    cause = error.__cause__ if error else None
    if isinstance(cause, DivergedError):
        return StressFault.NOT_FINITE
    if passes:
        return StressFault.PASSED_THROUGH
    return StressFault.NOT_AT_REST if isinstance(cause, TooManyStepsError) else None


def reach_m(scene: Scene) -> float:
    """Distance from the origin, in metres, that no cable of a scene can reach.

    The highest cable falls from H, and the wind carries it along; all of that speed may turn sideways, and friction on
    the floor brakes it. A cable may also roll out to its full length. The sum is doubled.
    """
    highest = max(cable.start_height_m + max(cable.rise_m, *cable.heights_m, 0.0) for cable in scene.cables)
    places = [np.hypot(each.x_m, each.y_m) + each.length_m for each in scene.cables]
    places += [np.hypot(each.x_m, each.y_m) + each.length_m for each in scene.sticks]
    speed = np.sqrt(2 * GRAVITY_M_S2 * highest) + scene.wind.speed_m_s
    in_air = scene.wind.speed_m_s * np.sqrt(2 * highest / GRAVITY_M_S2)
    slide = speed**2 / (2 * GRAVITY_M_S2 * scene.friction.floor) if scene.friction.floor > 0 else np.inf
    return float(2 * (max(places) + highest + in_air + slide))


@cache
def header_of(kind: str, seed: int) -> DatasetHeader:
    """Make a header whose surface and HDRI needn't exist, since nothing is rendered."""
    chosen = next(each for each in KINDS if each.name == kind)
    description = {"images": 1, "seed": seed, "style": chosen.style, **chosen.overrides}
    nothing = "0" * 64
    return DatasetHeader(
        farm_version=version("cable-farm"),
        spec=parse_spec(description, source="benchmark"),
        template=TemplateRef(path=None, sha256=nothing),
        surfaces=(BuiltinSurfaceRef(name="none", recipe_version=1),),
        hdris=(HdriRef(name="none", path=None, sha256=nothing, dark=False),),
    )
