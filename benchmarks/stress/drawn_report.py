"""The table, the failures and the plot of the drawn scenes."""

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.physics.gates import StressFault
from benchmarks.stress.drawn import DrawnResult
from benchmarks.stress.holds import Holding
from worker.simulate.checks.measure import Gate

MOST_AGAIN = 0.001
"""Share of the drawn scenes above which it is a failure that scenes are drawn again."""

_TARGET, _BOUND = Gate.CABLE_PENETRATION.value.target, Gate.CABLE_PENETRATION.value.never


def drawn_rows(results: Sequence[DrawnResult]) -> dict[str, list[DrawnResult]]:
    """Group results by kind, and those of each kind by what the scenes hold; a scene may be in several rows."""
    rows: dict[str, list[DrawnResult]] = {}
    for kind in dict.fromkeys(each.draw.kind for each in results):
        those = [each for each in results if each.draw.kind == kind]
        rows[kind] = those
        rows |= {f"{kind}: {held.value}": [each for each in those if held in each.holds] for held in Holding}
    return {name: those for name, those in rows.items() if those}


def drawn_table(results: Sequence[DrawnResult]) -> Table:
    """A table of the drawn scenes by kind and by what they hold."""
    table = Table(title="drawn scenes; penetration is each scene's 99.9th percentile over the radius")
    columns = ("scenes", "falls", "again", "passed", "median", "99 %", "most", f"> {_TARGET:g}", f"> {_BOUND:g}")
    for number, name in enumerate((*columns, "no rest", "CPU s", "99 %", "most")):
        table.add_column(name, justify="right" if number else "left")
    for name, those in drawn_rows(results).items():
        depth, cpu = depths(those), np.array([each.cpu_s for each in those])
        shares = [f"{np.mean(depth > limit):.2%}" for limit in (_TARGET, _BOUND)]
        table.add_row(
            "  " + name.split(": ")[1] if ": " in name else name,
            str(len(those)),
            str(sum(each.again is not None for each in those)),
            str(sum(each.passes > 0 for each in those)),
            *(f"{np.percentile(depth, share):.4f}" for share in (50, 99, 100)),
            *shares,
            str(sum(each.fault is StressFault.NOT_AT_REST for each in those)),
            f"{cpu.mean():.3f}",
            *(f"{np.percentile(cpu, share):.2f}" for share in (99, 100)),
        )
    return table


def depths(results: Sequence[DrawnResult]) -> NDArray[np.float64]:
    """Penetration of cables in each measured scene, the 99.9th percentile; a single 0 if there is none."""
    return np.array([each.figures.cable_penetration for each in results if each.figures] or [0.0])


def drawn_failures(results: Sequence[DrawnResult], out: Path) -> Iterator[str]:
    """A line for each scene that failed or is drawn again: the reasons, and the command that plays it again."""
    for each in results:
        if each.fault is None and each.again is None:
            continue
        faults = "" if each.fault is None else "; ".join((each.fault.value, *each.passages, ""))
        again = "" if each.again is None else f"drawn again: {each.again}; "
        yield f"{faults}{again}{drawn_replay_command(each, out)}"


def drawn_replay_command(result: DrawnResult, out: Path) -> str:
    """The command that plays this one scene again."""
    return f"python -m benchmarks stress --out {out} --seed {result.draw.seed} --only {result.draw.name}"


def reasons(results: Sequence[DrawnResult]) -> Iterator[str]:
    """Count the worker's reasons to draw scenes again, without their figures."""
    count = Counter(_without_figures(each.again) for each in results if each.again is not None)
    for reason, times in count.most_common():
        yield f"drawn again: {times} x {reason}"


def _without_figures(reason: str) -> str:
    return " ".join("#" if word[0].isdigit() else word for word in reason.split())


def too_many_again(results: Sequence[DrawnResult]) -> bool:
    """Whether more than `MOST_AGAIN` of the scenes are drawn again."""
    return sum(each.again is not None for each in results) > MOST_AGAIN * len(results)


def draw_depths(plane: Axes, results: Sequence[DrawnResult]) -> None:
    """Draw the share of the scenes that are deeper than any depth, a line for each row of the table."""
    for name, those in drawn_rows(results).items():
        depth = np.sort(depths(those))
        plane.step(depth, 1 - np.arange(len(depth)) / len(depth), where="pre", label=name)
    for limit in (_TARGET, _BOUND):
        plane.axvline(limit, color="0.5", linestyle=":")
    plane.set_xscale("symlog", linthresh=0.001)
    plane.set_xlim(left=0.0)
    plane.set_yscale("log")
    plane.set_xlabel("penetration over radius, 99.9th percentile of a scene")
    plane.set_ylabel("share of scenes that are deeper")
    plane.legend(fontsize="small")


def draw_seconds(plane: Axes, results: Sequence[DrawnResult]) -> None:
    """Draw how the processor's time of drawn scenes is spread, a line for each kind."""
    for kind in dict.fromkeys(each.draw.kind for each in results):
        seconds = np.sort([each.cpu_s for each in results if each.draw.kind == kind])
        plane.step(seconds, 1 - np.arange(len(seconds)) / len(seconds), where="pre", label=kind)
    plane.set_xscale("log")
    plane.set_yscale("log")
    plane.set_xlabel("CPU seconds of a fall and its watch")
    plane.set_ylabel("share of scenes that take longer")
    plane.legend(fontsize="small")
