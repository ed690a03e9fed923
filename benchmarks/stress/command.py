"""`python -m benchmarks stress`: play the scenes, in as many processes as wanted, and say what failed."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.progress import track

from benchmarks.stress.play import Result, play
from benchmarks.stress.report import (
    axis_table,
    failures,
    gate_table,
    kind_table,
    slowest_table,
    summary,
    write_json,
    write_plot,
)
from benchmarks.stress.scenes import Case, draw_cases
from benchmarks.terminal import bench_console

DEFAULT_RUNS = 560
"""Above the 500 that gate 10 asks for, and a whole number of each start."""

DEFAULT_PROCESSES = 2


def run(out: Path, *, seed: int, runs: int | None, only: int | None, processes: int | None) -> int:
    """Play all scenes, or the one with the number `only`; print, write `stress.json` and `stress.png` into `out`.

    Returns:
        0 if no run failed.

    Raises:
        ValueError: if there is no scene with that number.
    """
    cases = draw_cases(runs or DEFAULT_RUNS, seed)
    console = bench_console()
    if only is not None:
        if not 0 <= only < len(cases):
            raise ValueError(f"scene {only} is not one of 0 to {len(cases) - 1}")
        result = play(cases[only])
        console.print(result)
        return int(result.fault is not None)
    results = _play_all(cases, processes or DEFAULT_PROCESSES)
    return conclude(list(track(results, "runs", len(cases), console=console, transient=True)), out, console)


def conclude(results: Sequence[Result], out: Path, console: Console) -> int:
    """Print and write what came of all runs; 0 if none failed."""
    for table in (axis_table(results), kind_table(results), gate_table(results), slowest_table(results)):
        console.print(table)
    console.print(summary(results))
    failed = failures(results, out)
    for line in failed:
        console.print(line, soft_wrap=True, markup=False, highlight=False)
    write_json(out / "stress.json", results)
    write_plot(out / "stress.png", results)
    return int(bool(failed))


def _play_all(cases: Sequence[Case], processes: int) -> Iterator[Result]:
    """Results in the order of the cases; each run stands alone, so it does not matter which process plays it."""
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(play, cases, chunksize=1)
