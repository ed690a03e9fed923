"""The extremes of the stress test: their scenes, their judgement, and the report of a failure."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from benchmarks.__main__ import main
from benchmarks.physics.gates import STRESS_RUNS, StressFault
from benchmarks.stress.command import conclude
from benchmarks.stress.options import DEFAULT_RUNS
from benchmarks.stress.play import Result, play
from benchmarks.stress.report import replay_command
from benchmarks.stress.scenes import AXES, CROWD, Axis, Case, Start, draw_cases
from benchmarks.stress.starts import set_up
from tests.worker.settled import rod, shapes
from worker.simulate.checks.measure import measure

CASES = draw_cases(DEFAULT_RUNS, 0)


def test_there_are_enough_runs() -> None:
    """There are at least as many runs as gate 10 asks for."""
    assert DEFAULT_RUNS >= STRESS_RUNS
    assert [case.number for case in CASES] == list(range(DEFAULT_RUNS))


@pytest.mark.parametrize("axis", AXES, ids=lambda axis: axis.name)
def test_both_ends_of_each_axis_are_there_and_nothing_beyond(axis: Axis) -> None:
    """A twentieth of the scenes lies exactly at either end of each axis; with many cables lengths are shorter."""
    values = np.array([getattr(case, axis.name) for case in CASES if case.cables < CROWD])
    share = 0.02 if axis.name in {"length", "cables"} else 0.04
    assert (values.min(), values.max()) == (axis.low, axis.high)
    assert np.mean(values == axis.low) >= share
    assert np.mean(values == axis.high) >= share


@pytest.mark.parametrize(
    "axis", [axis for axis in AXES if axis.name not in {"cables", "length"}], ids=lambda axis: axis.name
)
def test_each_axis_is_covered_evenly(axis: Axis) -> None:
    """Each tenth of an axis has the same number of scenes, besides those at the ends.

    Numbers of cables are whole, and lengths are cut short where cables are many.
    """
    edges = [axis.at(share) for share in np.linspace(0, 1, 11)[1:-1]]
    counts = np.bincount(np.searchsorted(edges, [getattr(case, axis.name) for case in CASES]), minlength=10)
    inner = counts[1:-1] / len(CASES)
    assert inner == pytest.approx(0.09, abs=0.003)


def test_every_start_and_a_crowd_are_there() -> None:
    """Half of the scenes start in a hostile way, and each hostile way is equally common."""
    counts = {start: sum(case.start is start for case in CASES) for start in Start}
    assert counts.pop(Start.STACKED) == DEFAULT_RUNS // 2
    assert set(counts.values()) <= {DEFAULT_RUNS // 2 // 7, DEFAULT_RUNS // 2 // 7 + 1}
    assert sum(case.cables == CROWD for case in CASES) >= 10
    assert sum(case.mixed for case in CASES) == sum(case.aligned for case in CASES) == DEFAULT_RUNS // 2


def test_a_scene_is_drawn_alike_each_time() -> None:
    """Seed, number of runs and the scene's number decide the scene; another seed gives another one."""
    assert draw_cases(DEFAULT_RUNS, 0) == CASES
    assert draw_cases(DEFAULT_RUNS, 1) != CASES
    here, again = set_up(CASES[7]), set_up(draw_cases(DEFAULT_RUNS, 0)[7])
    assert all(np.array_equal(a.nodes_m, b.nodes_m) for a, b in zip(here.rods, again.rods, strict=True))
    assert (here.reach_m, here.max_time_s) == (again.reach_m, again.max_time_s)


def of_start(start: Start) -> Case:
    """A scene of five free cables, 2 mm thick."""
    case = next(case for case in CASES if case.start is start)
    return replace(case, cables=5, aligned=False, mixed=False, drop=0.1, length=100.0, radius=0.001)


@pytest.mark.parametrize("start", Start)
def test_rods_start_with_segments_of_one_length(start: Start) -> None:
    """Segments have equal lengths, as the solver requires, and none is shorter than the rod is thick."""
    for one in set_up(of_start(start)).rods:
        lengths = np.linalg.norm(np.diff(one.nodes_m, axis=0), axis=1)
        assert lengths == pytest.approx(lengths[0], rel=1e-9)
        assert lengths[0] > 2 * one.radius_m


def test_stacked_cables_start_apart_and_the_others_as_they_are_called() -> None:
    """The heights of the axes are as the name of each start says."""
    radius = 0.001
    heights = {
        start: np.sort([one.nodes_m[:, 2].mean() for one in set_up(of_start(start)).rods])
        for start in (Start.STACKED, Start.OVERLAPPING, Start.ONE_HEIGHT, Start.AT_FLOOR)
    }
    gaps = {start: np.diff(each) / radius for start, each in heights.items()}
    assert gaps[Start.STACKED] == pytest.approx(3.0)
    assert gaps[Start.OVERLAPPING] == pytest.approx(0.5)
    assert gaps[Start.ONE_HEIGHT] == pytest.approx(0.0, abs=1e-9)
    assert gaps[Start.AT_FLOOR] == pytest.approx(2.0)
    assert heights[Start.AT_FLOOR][0] == pytest.approx(radius)


def test_upright_cables_stand_on_their_ends_a_little_bent() -> None:
    """An upright cable is lowest at one end and slightly bent, since a straight one would balance."""
    for one in set_up(of_start(Start.UPRIGHT)).rods:
        assert one.nodes_m[0, 2] == pytest.approx(one.nodes_m[:, 2].min())
        chord = one.nodes_m[-1] - one.nodes_m[0]
        assert 0.99 < chord[2] / (one.segment_length_m * (len(one.nodes_m) - 1)) < 1 - 1e-6


def test_a_pile_in_the_floor_is_partly_below_it() -> None:
    """The lowest place of a pile in the floor is about a radius below the surface, its middle above."""
    setting = set_up(of_start(Start.IN_FLOOR))
    lowest = min(one.nodes_m[:, 2].min() for one in setting.rods) / setting.rods[0].radius_m
    assert -2 < lowest < 0


def test_thrown_cables_have_their_own_speeds() -> None:
    """Thrown cables have speeds of 2 to 8 m/s, and the others none."""
    speeds = np.linalg.norm(set_up(of_start(Start.THROWN)).velocities_m_s, axis=1)
    assert ((speeds >= 2) & (speeds <= 8)).all()
    assert len(set(speeds)) == 5
    assert not set_up(of_start(Start.STACKED)).velocities_m_s.any()


def made_up(number: int, fault: StressFault | None) -> Result:
    """A result without a run."""
    return Result(
        case=CASES[number],
        fault=fault,
        detail="2 of cables" if fault else "",
        figures=None if fault is StressFault.NOT_FINITE else measure(shapes(rod())),
        passes=0,
        end_slips=1,
        undone=0,
        sunk_nodes=0,
        fall_s=0.5,
        max_time_s=2.0,
        steps=250,
        cut=False,
        cpu_s=0.1,
    )


def test_a_failure_is_reported_with_the_command_that_replays_it(tmp_path: Path) -> None:
    """A failure is reported with number, seed and runs, the exit code isn't 0, and the files are written."""
    console = Console(width=130, record=True)
    results = [made_up(3, None), made_up(11, StressFault.PASSED_THROUGH), made_up(12, StressFault.NOT_FINITE)]
    assert conclude(results, [], tmp_path, console) == 1
    text = console.export_text()
    assert f"passed through (2 of cables), {CASES[11].start.value}: " in text
    assert f"python -m benchmarks stress --out {tmp_path} --seed 0 --runs {DEFAULT_RUNS} --only 11" in text
    assert "--only 3\n" not in text
    assert "2 of 3 runs failed" in text
    written = json.loads((tmp_path / "stress.json").read_text())["extremes"]
    assert [each["fault"] for each in written] == [None, "passed through", "not finite"]
    assert written[1]["case"]["number"] == 11
    assert (tmp_path / "stress.png").stat().st_size > 10_000


def test_no_failure_is_no_error(tmp_path: Path) -> None:
    """Without a failure the exit code is 0."""
    assert conclude([made_up(3, None)], [], tmp_path, Console(width=130, record=True)) == 0


def test_unrest_alone_is_told_and_decides_nothing(tmp_path: Path) -> None:
    """A run that does not rest is listed with its command, and the exit code stays 0."""
    console = Console(width=130, record=True)
    assert conclude([made_up(3, StressFault.NOT_AT_REST)], [], tmp_path, console) == 0
    assert "--only 3" in console.export_text()


def test_a_run_that_is_cut_off_is_not_blamed_for_unrest() -> None:
    """After one step no cable rests; what can't be known yet is no fault, and the run says that it was cut off."""
    result = play(of_start(Start.STACKED), most_steps=1)
    assert (result.cut, result.fault, result.steps) == (True, None, 1)


def test_a_run_that_is_cut_off_is_not_blamed_for_its_start_within_the_floor() -> None:
    """After one step a sunk cable is still below the floor, which no cable has passed."""
    result = play(of_start(Start.IN_FLOOR), most_steps=1)
    assert result.figures is not None
    assert result.figures.floor_pass_throughs > 0
    assert (result.cut, result.fault, result.passes) == (True, None, 0)


@pytest.mark.slow
def test_a_real_stress_test_agrees_with_its_replays(tmp_path: Path) -> None:
    """Six scenes in two processes give the same results as each one played alone."""
    code = main(["stress", "--out", str(tmp_path), "--runs", "6", "--drawn", "0", "--seed", "2", "--most-steps", "100"])
    written = json.loads((tmp_path / "stress.json").read_text())["extremes"]
    assert [each["case"]["number"] for each in written] == list(range(6))
    assert code == int(any(each["fault"] not in {None, "not at rest"} for each in written))
    for case, each in zip(draw_cases(6, 2), written, strict=True):
        alone = play(case, most_steps=100)
        assert (alone.fault and alone.fault.value, alone.steps) == (each["fault"], each["steps"])
        assert (alone.figures.model_dump() if alone.figures else None) == each["figures"]
    assert replay_command(draw_cases(6, 2)[0], tmp_path).endswith("--seed 2 --runs 6 --only 0")
