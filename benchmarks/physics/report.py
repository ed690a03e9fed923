"""The tables, the conclusions and the JSON file of the comparison."""

import itertools
import json
import math
import os
import platform
from collections.abc import Iterable, Iterator, Sequence
from importlib.metadata import version
from pathlib import Path

from rich import box
from rich.table import Table

from benchmarks.physics.contenders import Contender
from benchmarks.physics.rows import Row, best, closest, growth, is_rod_default, time_ratio
from benchmarks.physics.settings import COMPARED_COUNT, CROWDS
from worker.simulate.checks.measure import Gate

_PROCESSORS = Path("/proc/cpuinfo")
_PACKAGES = ("bpy", "numba", "numpy", "scipy")


def falls_table(rows: Sequence[Row], cables: int) -> Table:
    """Time and gates 1 to 4 of every setting on scenes of `cables` cables."""
    times = ("scenes", "CPU s\nmean", "CPU s\nmax", "steps", "fall s", "CPU s\na s")
    gates = ("length\n%", "cables\n%", "floor\n%", "through", "mm/s\nrms", "mm/s\nmax")
    title = f"{cables} cables" if cables > 1 else "1 cable"
    table = _table(f"{title}: CPU seconds of a fall, and the worst of each figure over the scenes", "setting", *times)
    for name in (*gates, "off", "never", "error"):
        table.add_column(name, justify="right")
    for row in rows:
        if row.cables != cables:
            continue
        worst = row.worst
        steps = sum(fall.steps for fall in row.falls) / len(row.falls)
        depths = (worst[gate] for gate in (Gate.CABLE_PENETRATION, Gate.FLOOR_PENETRATION))
        speeds = (worst[gate] for gate in (Gate.SPEED_RMS, Gate.SPEED_MAX))
        table.add_row(
            _name(row),
            str(len(row.falls)),
            *(f"{seconds:.3f}" for seconds in (row.cpu_s, row.cpu_max_s)),
            f"{steps:.0f}",
            *(f"{seconds:.2f}" for seconds in (row.fall_s, row.cost)),
            f"{100 * worst[Gate.LENGTH]:.3f}",
            *(f"{100 * depth:.1f}" for depth in depths),
            f"{worst[Gate.CABLE_PASS_THROUGH] + worst[Gate.FLOOR_PASS_THROUGH]:.0f}",
            *(f"{speed:.1f}" for speed in speeds),
            *(str(scenes) for scenes in (row.off_target, row.broken)),
            f"{row.error:.3g}",
        )
    return table


def textbook_table(rows: Iterable[Row]) -> Table:
    """A table of gates 5 and 6 of every setting."""
    problems = {row.setting: row for row in rows}
    first = next(iter(problems.values()))
    drops = [f"H/W at {each.slenderness:g}" for each in first.textbook.cantilevers]
    table = _table(
        "errors of one cable in %, whatever the scene", "setting", *drops, "over target", "lift-off", "reaction"
    )
    for row in problems.values():
        book = row.textbook
        crossing = ("-" if x is None else f"{100 * x:.2g}" for x in (book.lift_off_error, book.reaction_error))
        drooping = (f"{100 * each.error:.2g}" for each in book.cantilevers)
        table.add_row(_name(row), *drooping, f"{book.error:.2g}", *crossing)
    return table


def conclusions(rows: Sequence[Row]) -> Iterator[str]:
    """Say which setting is best for each contender, how the rods compare with the cloth, and how their cost grows.

    Yields:
        One line of text at a time.
    """
    yield (
        "error: the worst of gates 1, 2 and 5 over the rods' targets. off, never: scenes that miss a target of gates "
        "1 to 4, that break a bound. a s: for a simulated second. Bold: the defaults. The published cloth drops eight "
        "cables whatever it shows."
    )
    compared = [row for row in rows if row.cables == COMPARED_COUNT]
    for contender in Contender:
        those = [row for row in compared if row.setting.contender is contender]
        if those:
            yield f"{contender}, {COMPARED_COUNT} cables: {_verdict(those, contender)}"
    yield from _ratios(compared)
    yield from _growth({row.cables: row for row in rows if is_rod_default(row)})


def _verdict(rows: Sequence[Row], contender: Contender) -> str:
    strict = best(rows, Contender.ROD)
    if strict:
        return f"fastest that meets all targets is {_summary(strict)}"
    text = f"none meets all targets of the rods; the least error has {_summary(closest(rows))}"
    own = best(rows, contender)
    return f"{text}; the fastest that meets the cloth's own is {_summary(own)}" if own else text


def _ratios(rows: Sequence[Row]) -> Iterator[str]:
    rod = next((row for row in rows if is_rod_default(row)), None)
    cloths = [row for row in rows if row.setting.contender is Contender.CLOTH]
    if rod is None or not cloths:
        return
    rivals = {
        "default": next((row for row in cloths if row.setting.is_default), None),
        "fastest within its own targets": best(cloths, Contender.CLOTH),
        "least error": best(cloths, Contender.ROD) or closest(cloths),
    }
    for name, cloth in rivals.items():
        if cloth:
            yield (
                f"cloth's {name} ({cloth.setting.name}) takes {time_ratio(cloth, rod):.1f} times as long as the rods' "
                f"default on the same scenes of {rod.cables} cables: error {cloth.error:.2g} against {rod.error:.2g}"
            )


def _growth(by_count: dict[int, Row]) -> Iterator[str]:
    chain = [by_count[count] for count in (COMPARED_COUNT, *CROWDS) if count in by_count]
    for few, many in itertools.pairwise(chain):
        yield (
            f"rods, {few.cables} to {many.cables} cables: a simulated second costs {few.cost:.2f} and {many.cost:.2f} "
            f"s, which grows with the power {growth(few, many):.2f} of their number"
        )
    if len(chain) > 1:
        few, many = chain[0], chain[-1]
        yield (
            f"rods, {many.cables} cables over {few.cables}: {many.cpu_s / few.cpu_s:.1f} times the seconds of a fall, "
            f"{many.cost / few.cost:.1f} times those of a simulated second"
        )


def _summary(row: Row) -> str:
    return f"{row.setting.name} ({row.cpu_s:.2f} s, error {row.error:.2g})"


def write_json(path: Path, rows: Sequence[Row], *, seed: int, cpu_s: float) -> None:
    """Write every figure of every fall, and a description of the machine."""
    content = {
        "machine": machine(),
        "seed": seed,
        "cpu_seconds_of_the_run": cpu_s,
        "rows": [_plain(row) for row in rows],
        "conclusions": list(conclusions(rows)),
    }
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")


def machine() -> dict[str, object]:
    """A description of the machine: everything that affects speed."""
    lines = _PROCESSORS.read_text().splitlines() if _PROCESSORS.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return {
        "processor": names[0] if names else platform.processor(),
        "architecture": platform.machine(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        **{package: version(package) for package in _PACKAGES},
    }


def _plain(row: Row) -> dict[str, object]:
    return {
        "simulator": row.setting.contender.value,
        "setting": row.setting.name,
        "fall": row.setting.fall.model_dump(mode="json"),
        "is_default": row.setting.is_default,
        "cables": row.cables,
        "cpu_s": row.cpu_s,
        "cpu_max_s": row.cpu_max_s,
        "simulated_s": row.fall_s,
        "cpu_s_per_simulated_s": row.cost,
        "error_over_target": _finite(row.error),
        "meets_rod_targets": row.meets(Contender.ROD),
        "meets_own_targets": row.meets(row.setting.contender),
        "scenes_off_target": row.off_target,
        "scenes_never_allowed": row.broken,
        "worst": {gate.name.lower(): _finite(figure) for gate, figure in row.worst.items()},
        "cantilever_errors": {f"{each.slenderness:g}": _finite(each.error) for each in row.textbook.cantilevers},
        "lift_off_error": _finite(row.textbook.lift_off_error),
        "reaction_error": _finite(row.textbook.reaction_error),
        "falls": [
            {
                "cpu_s": fall.cpu_s,
                "simulated_s": fall.fall_s,
                "steps": fall.steps,
                "fault": fall.fault,
                "figures": fall.figures.model_dump() if fall.figures else None,
            }
            for fall in row.falls
        ],
    }


def _finite(figure: float | None) -> float | None:
    return figure if figure is not None and math.isfinite(figure) else None


def _name(row: Row) -> str:
    name = f"{row.setting.contender} {row.setting.name}"
    return f"[bold]{name}[/bold]" if row.setting.is_default else name


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, box=box.SIMPLE_HEAD, padding=0)
    for number, name in enumerate(columns):
        table.add_column(name, justify="right" if number else "left", no_wrap=not number)
    return table
