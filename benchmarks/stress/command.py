"""`python -m benchmarks stress`: play the scenes in several processes, and report the runs that failed."""

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from rich.console import Console
from rich.progress import track

from benchmarks.physics.gates import StressFault
from benchmarks.stress.drawn import DrawnResult, play_drawn
from benchmarks.stress.drawn_report import drawn_failures, drawn_table, reasons, too_many_again
from benchmarks.stress.kinds import Draw, draw_named
from benchmarks.stress.options import StressPlan
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


def run(out: Path, plan: StressPlan) -> int:
    """Play all scenes, or one alone; print, write `stress.json` and `stress.png` into `out`.

    Args:
        out: an existing folder.
        plan: the scenes.

    Returns:
        Exit code: 0 if no run failed.

    Raises:
        ValueError: if there is no such scene as the plan names.
    """
    console = bench_console()
    cases = draw_cases(plan.runs, plan.seed)
    if plan.only is not None:
        result = play_any(_named(plan.only, cases, plan.seed), plan.most_steps)
        console.print(result)
        return int(_decides(result))
    draws = plan.draws()
    results = list(
        track(_play_all([*cases, *draws], plan), "falls", len(cases) + len(draws), console=console, transient=True)
    )
    extremes = [each for each in results if isinstance(each, Result)]
    drawn = [each for each in results if isinstance(each, DrawnResult)]
    return conclude(extremes, drawn, out, console)


def conclude(extremes: Sequence[Result], drawn: Sequence[DrawnResult], out: Path, console: Console) -> int:
    """Print and write the results of all runs.

    Returns:
        0 if no run failed and few enough drawn scenes are drawn again, else 1. Unrest alone is told, and decides
        nothing: a drawn scene that does not rest is drawn again, and counts as such.
    """
    lines: list[str] = []
    if extremes:
        for table in (axis_table(extremes), kind_table(extremes), gate_table(extremes), slowest_table(extremes)):
            console.print(table)
        console.print(summary(extremes))
        lines += failures(extremes, out)
    if drawn:
        console.print(drawn_table(drawn))
        lines += [*reasons(drawn), *drawn_failures(drawn, out)]
    for line in lines:
        console.print(line, soft_wrap=True, markup=False, highlight=False)
    write_json(out / "stress.json", extremes, drawn)
    write_plot(out / "stress.png", extremes, drawn)
    return int(_any_decides([*extremes, *drawn]) or too_many_again(drawn))


def play_any(scene: Case | Draw, most_steps: int) -> Result | DrawnResult:
    """Play a drawn scene, or an extreme of at most `most_steps` time steps."""
    return play(scene, most_steps) if isinstance(scene, Case) else play_drawn(scene)


def _named(only: str, cases: Sequence[Case], seed: int) -> Case | Draw:
    if not only.isdigit():
        return draw_named(only, seed)
    if int(only) >= len(cases):
        raise ValueError(f"scene {only} is not one of 0 to {len(cases) - 1}")
    return cases[int(only)]


def _play_all(scenes: Sequence[Case | Draw], plan: StressPlan) -> Iterator[Result | DrawnResult]:
    """Results in the order of the scenes; runs are independent, so any process may play any of them."""
    with ProcessPoolExecutor(plan.processes, mp_context=get_context("spawn")) as pool:
        yield from pool.map(partial(play_any, most_steps=plan.most_steps), scenes, chunksize=1)


def _any_decides(results: Iterable[Result | DrawnResult]) -> bool:
    return any(_decides(result) for result in results)


def _decides(result: Result | DrawnResult) -> bool:
    return result.fault not in {None, StressFault.NOT_AT_REST}
