"""A benchmark's terminal: its table whole, and Blender's chatter kept out of it."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console

from worker.service.process_log import send_output_to

_TABLE_WIDTH = 130


def bench_console() -> Console:
    """A console that cuts no column off where the output is a file."""
    console = Console()
    return console if console.is_terminal else Console(width=_TABLE_WIDTH)


@contextmanager
def progress_console() -> Iterator[Console]:
    """A console that still writes to the terminal while `blender_writes_to` sends everything else to a file."""
    with os.fdopen(os.dup(1), "w") as terminal:
        yield Console(file=terminal)


@contextmanager
def blender_writes_to(log_file: Path) -> Iterator[None]:
    """Send the output of this process, C code's included, to a file for a while."""
    sys.stdout.flush()
    sys.stderr.flush()
    kept = os.dup(1), os.dup(2)
    send_output_to(log_file)
    try:
        yield
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        for target, copy in enumerate(kept, start=1):
            os.dup2(copy, target)
            os.close(copy)
