"""Shows progress to people: bars on a terminal, elsewhere a plain line at intervals."""

import time
from contextlib import ExitStack
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn
from rich.table import Table

from farm.run.progress import Progress as DatasetProgress
from farm.run.registry.port import RunState, WorkerState
from farm.spec.category import Category

_PLAIN_EVERY_S = 15.0
"""Time between two plain lines, in seconds, where the output is no terminal: a long run does not fill a log."""


def console(*, results: bool = False) -> Console:
    """Make the console for progress and remarks, on standard error, or the one for results, on standard output."""
    return Console(stderr=not results, highlight=False, soft_wrap=True)


def one_line(text: str) -> str:
    """Make a text printable, and one line: names of files may hold line ends, and bytes that are no text."""
    printable = "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in text)
    return printable.encode(errors="backslashreplace").decode()


def duration(seconds: float) -> str:
    """Write a number of seconds for people: `2 h 05 min`, `3 min 20 s`, `12 s`."""
    minutes, rest = divmod(round(seconds), 60)
    if minutes >= 60:
        return f"{minutes // 60} h {minutes % 60:02d} min"
    return f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"


def summary(progress: DatasetProgress) -> str:
    """Put progress in one line: images done, images an hour, time left, failures, held workers."""
    parts = [f"{progress.done} of {progress.quota} done"]
    if progress.running:
        parts.append(f"{len(progress.running)} running")
    if progress.images_per_hour is not None:
        parts.append(f"{progress.images_per_hour:.0f} an hour")
    if progress.seconds_left is not None:
        parts.append(f"{duration(progress.seconds_left)} left")
    if progress.quarantined:
        parts.append(f"{len(progress.quarantined)} failed")
    if progress.state is RunState.PAUSED:
        parts.append("paused")
    held = [report for report in progress.workers or () if report.state is WorkerState.HELD]
    if held:
        parts.append(f"{len(held)} workers held back: {held[0].reason}")
    if progress.unserved:
        parts.append(progress.unserved)
    if progress.trouble:
        parts.append(progress.trouble)
    return ", ".join(parts)


def table(progress: DatasetProgress) -> Table:
    """Make a table with a row for each category: images done, and quota."""
    grid = Table(box=None, pad_edge=False)
    grid.add_column("category")
    grid.add_column("done", justify="right")
    grid.add_column("quota", justify="right")
    for category, count in progress.categories.items():
        grid.add_row(category, str(count.done), str(count.quota))
    grid.add_row("all", str(progress.done), str(progress.quota), style="bold")
    return grid


class ProgressDisplay:
    """Shows how a dataset grows, inside `with`."""

    def __init__(self, screen: Console) -> None:
        self._screen = screen
        self._stack = ExitStack()
        self._bars: Progress | None = None
        self._tasks: dict[Category, TaskID] = {}
        self._line: TaskID | None = None
        self._last_plain_s = float("-inf")
        self._last_done = -1

    def __enter__(self) -> Self:
        """Start the bars, if the output is a terminal."""
        if self._screen.is_terminal:
            columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
            self._bars = self._stack.enter_context(Progress(*columns, console=self._screen))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Stop the bars, which restores the terminal."""
        self._stack.close()

    def show(self, progress: DatasetProgress) -> None:
        """Show the newest progress."""
        if self._bars is None:
            self._show_plain(progress)
            return
        for category, count in progress.categories.items():
            if not count.quota:
                continue
            if category not in self._tasks:
                self._tasks[category] = self._bars.add_task(category, total=count.quota)
            self._bars.update(self._tasks[category], completed=count.done)
        if self._line is None:
            self._line = self._bars.add_task("", total=progress.quota)
        last = f"\n{progress.last_picture}" if progress.last_picture else ""
        self._bars.update(self._line, description=summary(progress) + last, completed=progress.done)

    def _show_plain(self, progress: DatasetProgress) -> None:
        now_s = time.monotonic()
        finished = progress.done == progress.quota and progress.done != self._last_done
        if finished or now_s - self._last_plain_s >= _PLAIN_EVERY_S:
            last = f"; last {progress.last_picture}" if progress.last_picture else ""
            self._screen.print(summary(progress) + last, markup=False)
            self._last_plain_s = now_s
        self._last_done = progress.done
