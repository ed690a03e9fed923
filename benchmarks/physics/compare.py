"""The whole comparison: play, report, write the files and verify."""

import time
from collections.abc import Sequence
from pathlib import Path

from rich.progress import track

from benchmarks.physics.contenders import Contender
from benchmarks.physics.measure import play, warm_up
from benchmarks.physics.plot import write_plot
from benchmarks.physics.report import conclusions, falls_table, textbook_table, write_json
from benchmarks.physics.rows import Row, Textbook, verify_default
from benchmarks.physics.scenes import bench_scenes
from benchmarks.physics.settings import Setting
from benchmarks.physics.textbook import textbook
from benchmarks.terminal import bench_console, blender_writes_to
from blend.build import TEMPLATE
from blend.contract import open_template

_WARM_UP_CABLES = 4
"""Cables of the scene that loads and compiles everything before anything is timed: enough for contacts."""


def compare(out: Path, settings: Sequence[Setting], *, seed: int, scenes: int, start_s: float) -> int:
    """Measure, print, write `physics.json` and `physics.png`.

    Args:
        out: a folder that is there.
        settings: the settings to compare.
        seed: the seed that the scenes are drawn from.
        scenes: most scenes for a setting.
        start_s: processor seconds that the process had taken when the run began.

    Raises:
        VerificationError: if the rod solver breaks a gate's bound at its default, or ends in places that aren't finite.
        TemplateError: if the template can't be opened.
    """
    console = bench_console()
    log_file = out / "physics.log"
    with blender_writes_to(log_file):
        if any(setting.contender is not Contender.ROD for setting in settings):
            open_template(TEMPLATE)
        warm_up(settings, bench_scenes(1, _WARM_UP_CABLES, seed)[0])
    books: dict[Setting, Textbook] = {}
    rows = []
    # Settings that are compared are played in succession, so that a drift in the machine's speed affects all equally.
    counts = sorted({count for setting in settings for count in setting.counts})
    plan = [(setting, count) for count in counts for setting in settings if count in setting.counts]
    for setting, count in track(plan, "settings", console=console, transient=True):
        with blender_writes_to(log_file):
            if setting not in books:
                books[setting] = textbook(setting)
            played = play(setting, bench_scenes(min(scenes, setting.most_scenes), count, seed))
        rows.append(Row(setting, count, played, books[setting]))
    for count in counts:
        console.print(falls_table(rows, count))
    console.print(textbook_table(rows))
    for line in conclusions(rows):
        console.print(line, soft_wrap=True, highlight=False, markup=False)
    cpu_s = time.process_time() - start_s
    console.print(f"all on one core; {cpu_s:.0f} CPU seconds in all", highlight=False)
    write_json(out / "physics.json", rows, seed=seed, cpu_s=cpu_s)
    write_plot(out / "physics.png", rows)
    verify_default(rows)
    return 0
