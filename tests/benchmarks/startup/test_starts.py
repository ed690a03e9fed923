"""The benchmark of a worker's start: time by library, the figures of a start, and one real start."""

import io
import json
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from benchmarks.startup.imports import OWN, ROD, seconds_by_library
from benchmarks.startup.report import once_table, start_table, write_json
from benchmarks.startup.starts import Start, read_start
from farm.errors import VerificationError

# In the interpreter's format: a module's imports come before it, indented by two more spaces.
IMPORTS = """\
import time: self [us] | cumulative | imported package
import time:       100 |        100 | site
import time:      1000 |       1000 |     redis.client
import time:       500 |       1500 |   redis
import time:      2000 |       2000 |   numpy
import time:       300 |       3800 | worker.cli
a line of Blender's
import time:      4000 |       4000 |       numpy.testing
import time:      6000 |      10000 |     numba
import time:       700 |      10700 |   worker.simulate.rod.compiled
import time:      9000 |       9000 |   bpy
import time:       200 |      19900 | worker.blender.renderer
"""


def content(again: str = "a") -> dict[str, Any]:
    """The content of the file that a start's process writes."""
    pictures = [
        {"seconds": {"render": 2.0, "other": 0.5}, "sha256": "a", "device": "cpu"},
        {"seconds": {"render": 1.0, "other": 0.5}, "sha256": again, "device": "cpu"},
    ]
    steps = {"interpreter": 0.01, "main": 0.1, "child": 1.0}
    return {"steps": steps, "open_s": 0.2, "pictures": pictures, "compiled": {"read": 6, "compiled": 0}}


def test_seconds_go_to_the_outermost_library() -> None:
    """NumPy's time counts as numba's if numba imports it."""
    assert seconds_by_library(IMPORTS, "worker.blender.renderer") == pytest.approx(
        {"numba": 0.010, ROD: 0.0007, "Blender": 0.009, OWN: 0.0002}
    )


def test_a_module_that_was_not_imported_took_no_time() -> None:
    """A module that wasn't imported, as in a process that ended early, took no time."""
    assert seconds_by_library("Killed", "worker.blender.renderer") == {}


def test_a_start_adds_up_to_its_first_picture() -> None:
    """The steps add up to the clock's time, whatever the imports' own seconds leave out."""
    start = read_start(content(), IMPORTS)
    assert start.until_open_s == pytest.approx(1.31)
    assert start.until_first_picture_s == pytest.approx(3.81)
    assert start.main["Redis client"] == pytest.approx(0.0015)


def test_two_pictures_that_differ_are_refused() -> None:
    """Two different pictures of one job are refused."""
    with pytest.raises(VerificationError, match="two different pictures"):
        read_start(content(again="b"), IMPORTS)


def test_the_tables_tell_steps_and_what_is_paid_once() -> None:
    """The tables hold the median and the least of all starts, and the first picture less the second."""
    starts = [read_start(content(), IMPORTS) for _ in range(2)]
    written = io.StringIO()
    console = Console(width=130, file=written)
    console.print(start_table(starts, 128))
    console.print(once_table(starts))
    text = written.getvalue()
    assert "import Blender" in text
    assert any(line.split() == ["all", "3.810", "3.810"] for line in text.splitlines())
    assert any(line.split() == ["render", "2.000", "1.000", "+1.000"] for line in text.splitlines())


def test_the_json_holds_every_start(tmp_path: Path) -> None:
    """The JSON holds every start and the median of all."""
    starts: list[Start] = [read_start(content(), IMPORTS)] * 3
    write_json(tmp_path / "startup.json", starts, seed=4)
    written = json.loads((tmp_path / "startup.json").read_text())
    assert written["median_s"] == pytest.approx(3.81)
    assert [start["device"] for start in written["starts"]] == ["cpu"] * 3
