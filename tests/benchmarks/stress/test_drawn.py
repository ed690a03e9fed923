"""Drawn scenes: which are played, and how they are judged."""

from collections import Counter

import pytest

from benchmarks.physics.gates import StressFault
from benchmarks.stress import drawn
from benchmarks.stress.drawn import header_of, play_drawn, reach_m
from benchmarks.stress.kinds import KINDS, TANGLES, Draw, Kind, draw_named, draws_of
from benchmarks.stress.options import StressPlan
from farm.errors import MessageError, SceneError
from farm.spec.category import Category
from farm.spec.job import Job
from worker.sample.scene import sample_scene
from worker.simulate.rod.fall import drop_cables
from worker.simulate.rod.simulation import DivergedError, TooManyStepsError


def test_there_are_as_many_scenes_of_each_category() -> None:
    """The plan's 3,000 scenes are 500 of each category, all different: two thirds of `wide`, the others tangles."""
    draws = StressPlan().draws()
    counts = Counter(Job.from_id(draw.job).category for draw in draws)
    assert counts == dict.fromkeys(Category, 500)
    assert len(set(draws)) == 3000
    assert Counter(draw.kind for draw in draws) == {"wide": 1980, **dict.fromkeys(TANGLES, 204)}


def test_a_kind_without_a_number_is_played_only_where_it_is_named() -> None:
    """`published` has none of its own."""
    assert "published" not in {draw.kind for draw in StressPlan(drawn=2).draws()}
    assert {draw.kind for draw in StressPlan(drawn=2, kinds=("published",)).draws()} == {"published"}


def test_a_scene_is_named_by_kind_and_job() -> None:
    """A name finds the scene that has it, and what names none is refused."""
    (draw,) = draws_of(KINDS[0], 1, 77)
    assert draw_named(draw.name, 77) == draw
    with pytest.raises(ValueError, match="KIND:JOB"):
        draw_named("nothing:far-000001", 77)
    with pytest.raises(MessageError):
        draw_named("wide:far", 77)


def test_a_kinds_overrides_reach_the_description(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kind may override any range of its style."""
    coils = Kind("coils", 1, overrides={"ranges": {"placement": {"coil_share": 1.0}}})
    monkeypatch.setattr(drawn, "KINDS", (coils,))
    assert header_of("coils", 0).spec.ranges.placement.coil_share == 1.0


def test_a_drawn_scene_falls_as_a_worker_lets_it_fall() -> None:
    """The fall has the steps and the figures of the worker's own, and a sound scene has no fault."""
    draw = Draw("published", 0, "far-000000")
    header = header_of(draw.kind, draw.seed)
    own = drop_cables(sample_scene(header, Job.from_id(draw.job), 0), header.spec.fall.rod)
    result = play_drawn(draw)
    assert (result.steps, result.fall_s) == (own.steps, own.fall_s)
    assert result.figures is not None
    assert (result.fault, result.again, result.passes) == (None, None, 0)
    assert play_drawn(draw).figures == result.figures


def test_no_start_is_beyond_reach() -> None:
    """A scene's reach is farther away than any cable's start."""
    scene = sample_scene(header_of("wide", 0), Job.from_id("far-000000"), 0)
    assert reach_m(scene) > max(cable.length_m for cable in scene.cables)


@pytest.mark.parametrize(
    ("cause", "fault"),
    [(DivergedError(), StressFault.NOT_FINITE), (TooManyStepsError(), StressFault.NOT_AT_REST), (None, None)],
)
def test_a_fall_that_is_given_up_counts_as_drawn_again(
    monkeypatch: pytest.MonkeyPatch, cause: Exception | None, fault: StressFault | None
) -> None:
    """What the solver could not end is its fault; a scene that could not be laid out is only drawn again."""

    def give_up(*_: object) -> None:
        raise SceneError("given up") from cause

    monkeypatch.setattr(drawn, "drop_cables", give_up)
    result = play_drawn(Draw("published", 0, "far-000000"))
    assert (result.fault, result.again, result.figures) == (fault, "given up", None)
