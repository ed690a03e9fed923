"""What is told of drawn scenes. No rod falls."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from rich.console import Console

from benchmarks.physics.gates import StressFault
from benchmarks.stress.command import conclude
from benchmarks.stress.drawn import DrawnResult
from benchmarks.stress.drawn_report import MOST_AGAIN, drawn_rows, reasons, too_many_again
from benchmarks.stress.holds import Holding
from benchmarks.stress.kinds import Draw
from tests.worker.settled import rod, shapes
from worker.simulate.checks.measure import measure

SOUND = DrawnResult(
    draw=Draw("wide", 77, "far-000001"),
    holds=(Holding.COIL, Holding.STICK),
    fault=None,
    again=None,
    figures=measure(shapes(rod())),
    passes=0,
    end_slips=0,
    passages=(),
    undone=0,
    fall_s=0.4,
    steps=400,
    cpu_s=0.2,
)


def test_a_scene_counts_in_the_row_of_everything_that_it_holds() -> None:
    """A kind has a row, and each thing that its scenes hold; a row without scenes is left out."""
    plain = replace(SOUND, holds=(Holding.PLAIN,))
    rows = drawn_rows([SOUND, plain])
    assert {name: len(those) for name, those in rows.items()} == {
        "wide": 2,
        "wide: coil": 1,
        "wide: stick": 1,
        "wide: plain": 1,
    }


def test_reasons_are_counted_without_their_figures() -> None:
    """Two scenes that are too deep are drawn again for one reason."""
    deep = [replace(SOUND, again=f"cable penetration over radius {depth} is above 0.1") for depth in (0.2, 0.3)]
    assert list(reasons([SOUND, *deep])) == ["drawn again: 2 x cable penetration over radius # is above #"]


def test_a_failure_is_told_with_place_and_command(tmp_path: Path) -> None:
    """A passage makes the exit code 1; its line says where and when it was, and how to play the scene alone."""
    console = Console(width=200, record=True)
    passed = replace(SOUND, fault=StressFault.PASSED_THROUGH, passes=1, passages=("rods 0 and 1 at 3 and 4 radii",))
    assert conclude([], [SOUND, passed], tmp_path, console) == 1
    text = console.export_text()
    assert "passed through; rods 0 and 1 at 3 and 4 radii" in text
    assert f"python -m benchmarks stress --out {tmp_path} --seed 77 --only wide:far-000001" in text
    assert (tmp_path / "stress.png").stat().st_size > 10_000


def test_few_scenes_may_be_drawn_again(tmp_path: Path) -> None:
    """One of 1,000 may be drawn again; two are too many, whatever the reason."""
    again = replace(SOUND, again="speed in mm/s 6 is above 5")
    most = round(1000 * MOST_AGAIN)
    assert not too_many_again([*[again] * most, *[SOUND] * (1000 - most)])
    assert too_many_again([*[again] * (most + 1), *[SOUND] * (999 - most)])
    assert conclude([], [again, SOUND], tmp_path, Console(width=200, record=True)) == 1
    assert np.isclose(MOST_AGAIN, 0.001)
