"""Progress for people."""

import os
from io import StringIO

import pytest
from rich.console import Console

from farm.cli.display import ProgressDisplay, duration, one_line, summary
from farm.run.progress import CategoryProgress, Progress
from farm.run.registry.port import RunState, WorkerReport, WorkerState
from farm.spec.category import Category

IDLE = WorkerReport(name="a@b", state=WorkerState.IDLE)
HELD = WorkerReport(name="a@b", state=WorkerState.HELD, reason="disk full")


def progress(done: int) -> Progress:
    """Progress with this many of four images done."""
    return Progress(
        location="store/cables",
        spec_sha256="0" * 64,
        categories={
            Category.FAR: CategoryProgress(done=done, quota=4),
            Category.FAR_ALIGNED: CategoryProgress(done=0, quota=0),
        },
        running=("far-000003",),
        quarantined={"far-000000": "reason"},
        images_per_hour=120.0,
        seconds_left=95.0,
        last_picture="far/images/far-000002.png",
    )


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.4, "0 s"), (59.6, "1 min 00 s"), (95, "1 min 35 s"), (7500, "2 h 05 min")]
)
def test_duration(seconds: float, words: str) -> None:
    """Durations are written in the units that people use."""
    assert duration(seconds) == words


def test_summary() -> None:
    """One line holds everything that is known."""
    assert summary(progress(3)) == "3 of 4 done, 1 running, 120 an hour, 1 min 35 s left, 1 failed"


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({"state": RunState.PAUSED}, "paused"),
        ({"unserved": "no worker serves this run"}, "no worker serves this run"),
        ({"trouble": "Redis went away; waiting for it"}, "Redis went away; waiting for it"),
        (
            {"workers": (HELD,)},
            "1 workers held back: disk full",
        ),
    ],
)
def test_summary_tells_what_holds_a_run_up(known: dict[str, object], words: str) -> None:
    """A paused run, an absent Redis and workers that are held back are mentioned."""
    assert summary(progress(3).model_copy(update=known)).endswith(f"1 failed, {words}")


@pytest.mark.parametrize("known", [{"state": RunState.ACTIVE}, {"workers": (IDLE,)}])
def test_summary_is_short_when_all_is_well(known: dict[str, object]) -> None:
    """Things that are in order aren't mentioned."""
    assert summary(progress(3).model_copy(update=known)) == summary(progress(3))


def test_plain_lines_are_few() -> None:
    """Without a terminal, many looks print few lines: the first and the last."""
    out = StringIO()
    with ProgressDisplay(Console(file=out, width=200)) as display:
        for done in (0, 1, 1, 2, 3, 4, 4):
            display.show(progress(done))
    lines = out.getvalue().splitlines()
    assert [line.partition(",")[0] for line in lines] == ["0 of 4 done", "4 of 4 done"]
    assert "\x1b" not in out.getvalue()


def test_bars_on_a_terminal() -> None:
    """On a terminal each category with a quota has a bar, and the last picture is named."""
    out = StringIO()
    with ProgressDisplay(Console(file=out, width=200, force_terminal=True)) as display:
        display.show(progress(3))
    assert "3/4" in out.getvalue()
    assert "far_aligned" not in out.getvalue()
    assert "far-000002.png" in out.getvalue()


def test_names_of_files_are_printed_in_one_line() -> None:
    """Line ends, escapes of terminals and bytes that are no text are spelt out; letters of all languages stay."""
    odd = os.fsdecode(b"caf\xe9") + " two\nlines\r\x1b[31m" + " naïve 猫 a\\b"
    shown = one_line(odd)
    assert shown == r"caf\udce9 two\nlines\r\x1b[31m" + " naïve 猫 a\\b"
    shown.encode()
