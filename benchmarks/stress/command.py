"""`python -m benchmarks stress`: play the scenes in several processes, and report the runs that failed."""

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
"""Scenes unless the command line says otherwise: more than gate 10's 500, and the same number for each start."""

DEFAULT_PROCESSES = 2
"""Processes at the same time unless the command line says otherwise."""


def run(out: Path, *, seed: int, runs: int | None, only: int | None, processes: int | None) -> int:
    """Play all scenes, or one alone; print, write `stress.json` and `stress.png` into `out`.

    Args:
        out: an existing folder.
        seed: seed of the scenes.
        runs: number of scenes; `DEFAULT_RUNS` if None.
        only: number of the one scene to play; None for all.
        processes: number of processes at the same time; `DEFAULT_PROCESSES` if None.

    Returns:
        Exit code: 0 if no run failed.

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
    """Print and write the results of all runs; return 0 if none failed, else 1."""
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
    """Results in the order of the cases; runs are independent, so any process may play any of them."""
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(play, cases, chunksize=1)
