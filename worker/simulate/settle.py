"""The attempts at a job: draw a scene, let it fall, measure it, and try again until a scene may be shipped.

The caller hands in how scenes are drawn and which simulator drops them, so nothing here needs Blender.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from farm.dataset.manifest import RejectedAttempt, SettleFigures
from farm.errors import SceneError
from farm.scene.scene import Scene
from farm.spec.job import Job
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import CableShapes
from worker.stopwatch import Stopwatch

Draw = Callable[[int], Scene]
"""Draws the scene of an attempt, given its number from 0."""

Drop = Callable[[Scene], CableShapes]
"""Lets a scene's cables fall until they rest; raises SceneError if the simulator diverges."""

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class MeasuredFall:
    """A scene after its fall, whether it may be shipped or not.

    Attributes:
        scene: the scene as drawn.
        shapes: its settled cables and sticks.
        figures: the measured gates; None if the scene has no cables.
    """

    scene: Scene
    shapes: CableShapes
    figures: SettleFigures | None


def settle(
    job: Job, draw: Draw, drop: Drop, show: Callable[[MeasuredFall], T], max_attempts: int, watch: Stopwatch
) -> tuple[T, tuple[RejectedAttempt, ...]]:
    """Try scenes of a job until one passes all checks.

    Args:
        job: the job, for messages.
        draw: the source of scenes.
        drop: the simulator.
        show: maker of what a picture shows of a sound fall; it raises SceneError if the picture shows too little.
        max_attempts: number of scenes to try, at least 1.
        watch: clock that counts the stages `randomize`, `simulate` and `check`.

    Returns:
        What `show` makes of the first scene that passes, and the attempts before it with the reason against each.

    Raises:
        SceneError: if no scene passes.
    """

    def attempt(number: int) -> T:
        fall = let_fall(number, draw, drop, watch)
        fault = None if fall.figures is None else find_fault(fall.figures) or find_unrest(fall.shapes)
        if fault is not None:
            raise SceneError(fault)
        return show(fall)

    return first_accepted(job, attempt, max_attempts)


def find_unrest(shapes: CableShapes) -> str | None:
    """Find the reason why cables that were slow when they were captured did not rest; None if they did."""
    if shapes.rested:
        return None
    return (
        f"the cables did not come to rest within {shapes.fall_s:.3g} s: they paused, and would have moved on "
        "(max_time_s or max_frames of [fall] ended the fall)"
    )


def let_fall(number: int, draw: Draw, drop: Drop, watch: Stopwatch) -> MeasuredFall:
    """Draw the scene of one attempt, let it fall and measure it; see `settle`.

    Raises:
        SceneError: if the simulator diverges.
    """
    with watch.stage("randomize"):
        scene = draw(number)
    with watch.stage("simulate"):
        shapes = drop(scene)
    with watch.stage("check"):
        figures = measure(shapes) if scene.cables else None
    return MeasuredFall(scene, shapes, figures)


def first_accepted(job: Job, attempt: Callable[[int], T], max_attempts: int) -> tuple[T, tuple[RejectedAttempt, ...]]:
    """Make attempts, counted from 0, until one raises no SceneError.

    Returns:
        The result of that attempt, and the attempts before it with the reason against each.

    Raises:
        SceneError: if every attempt raises one.
    """
    rejected: list[RejectedAttempt] = []
    for number in range(max_attempts):
        try:
            return attempt(number), tuple(rejected)
        except SceneError as error:
            rejected.append(RejectedAttempt(attempt=number, reason=str(error)))
    raise SceneError(
        f"{job.id}: none of {len(rejected)} drawn scenes passed the checks; the last: {rejected[-1].reason}"
    )
