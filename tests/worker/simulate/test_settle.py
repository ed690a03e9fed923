"""Attempts at a job: which scene is taken, and what is told of those before it. No simulator runs."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from farm.errors import SceneError
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.job import Job
from tests.worker.scenes import make_scene
from tests.worker.settled import RADIUS, rod, shapes
from worker.simulate.settle import MeasuredFall, first_accepted, let_fall, settle
from worker.simulate.shapes import NOTHING_FELL, CableShapes
from worker.stopwatch import Stopwatch

JOB = Job(category=Category.FAR, index=0)
SOUND = shapes(rod())
FLOATING = shapes(rod(z=2 * RADIUS))


def draw(attempt: int) -> Scene:
    """The scene of an attempt at the job."""
    return make_scene(attempt=attempt)


def falling(*ends: CableShapes | None) -> Callable[[Scene], CableShapes]:
    """A simulator whose falls end as given, one after the other; None stands for one that diverges."""
    left = iter(ends)

    def drop(_: Scene) -> CableShapes:
        end = next(left)
        if end is None:
            raise SceneError("the solver diverged")
        return end

    return drop


def as_it_is(fall: MeasuredFall) -> MeasuredFall:
    """A picture shows all of any fall."""
    return fall


def test_the_first_sound_scene_is_taken() -> None:
    """No further scene is drawn after it."""
    fall, rejected = settle(JOB, draw, falling(SOUND), as_it_is, 3, Stopwatch())
    assert (fall.scene.attempt, fall.shapes, rejected) == (0, SOUND, ())


def test_a_fault_has_the_next_scene_drawn() -> None:
    """The rejected attempt is told with its reason."""
    fall, rejected = settle(JOB, draw, falling(FLOATING, SOUND), as_it_is, 3, Stopwatch())
    assert fall.scene.attempt == 1
    assert [(each.attempt, each.reason) for each in rejected] == [(0, "gap below a cable over radius 1 is above 0.5")]


def test_a_fall_that_diverges_has_the_next_scene_drawn() -> None:
    """The simulator's own message is the reason."""
    fall, rejected = settle(JOB, draw, falling(None, SOUND), as_it_is, 3, Stopwatch())
    assert fall.scene.attempt == 1
    assert [each.reason for each in rejected] == ["the solver diverged"]


def test_a_fall_that_met_its_end_in_motion_has_the_next_scene_drawn() -> None:
    """Cables may be slow at the moment of capture and move on: only those that rested are at rest."""
    fall, rejected = settle(JOB, draw, falling(replace(SOUND, rested=False), SOUND), as_it_is, 3, Stopwatch())
    assert fall.scene.attempt == 1
    (first,) = rejected
    assert first.reason.startswith("the cables did not come to rest within 0.5 s")
    assert "max_time_s" in first.reason


def test_a_sound_scene_that_shows_too_little_has_the_next_scene_drawn() -> None:
    """What is shown is judged after the fall, and the result is what is made of the scene that shows enough."""

    def show(fall: MeasuredFall) -> str:
        if fall.scene.attempt == 0:
            raise SceneError("shows nothing")
        return f"shown {fall.scene.attempt}"

    shown, rejected = settle(JOB, draw, falling(SOUND, SOUND), show, 3, Stopwatch())
    assert shown == "shown 1"
    assert [(each.attempt, each.reason) for each in rejected] == [(0, "shows nothing")]


def test_an_unsound_scene_is_not_shown() -> None:
    """Nothing is labelled for a scene that the checks of its fall reject."""
    shown: list[int] = []
    settle(JOB, draw, falling(FLOATING, SOUND), lambda fall: shown.append(fall.scene.attempt), 3, Stopwatch())
    assert shown == [1]


def test_a_scene_without_cables_has_no_figures_and_no_fault() -> None:
    """There is nothing to measure, and nothing to reject."""
    empty = make_scene().model_copy(update={"cables": ()})
    fall, rejected = settle(JOB, lambda _: empty, falling(NOTHING_FELL), as_it_is, 3, Stopwatch())
    assert (fall.figures, rejected) == (None, ())


def test_a_job_without_a_sound_scene_ends_in_a_scene_error() -> None:
    """It names the job, the number of attempts and the last reason."""
    with pytest.raises(SceneError, match=r"far-000000: none of 2 drawn scenes .*the last: the solver diverged"):
        settle(JOB, draw, falling(FLOATING, None), as_it_is, 2, Stopwatch())


def test_the_stages_of_all_attempts_are_counted() -> None:
    """A fall that diverges has no check."""
    watch = Stopwatch()
    settle(JOB, draw, falling(None, SOUND), as_it_is, 2, watch)
    assert list(watch.stages_s) == ["randomize", "simulate", "check"]


def test_a_fall_alone_is_measured_and_not_judged() -> None:
    """A cable in the air comes back with its figures."""
    fall = let_fall(0, draw, falling(FLOATING), Stopwatch())
    assert fall.figures is not None
    assert fall.figures.support_gap == pytest.approx(1.0)


def test_attempts_end_at_the_first_that_is_accepted() -> None:
    """Whatever an attempt makes."""

    def attempt(number: int) -> str:
        if number < 2:
            raise SceneError(f"no {number}")
        return f"yes {number}"

    made, rejected = first_accepted(JOB, attempt, 5)
    assert made == "yes 2"
    assert [each.reason for each in rejected] == ["no 0", "no 1"]
