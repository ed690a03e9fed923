"""A benchmark's terminal: tables keep all columns, and Blender's messages go to a file."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console

from worker.service.process_log import send_output_to

_TABLE_WIDTH = 130
"""Width of a table in a file, characters: enough for the widest one."""


def bench_console() -> Console:
    """A console that cuts no column off if the output is a file."""
    console = Console()
    return console if console.is_terminal else Console(width=_TABLE_WIDTH)


@contextmanager
def progress_console() -> Iterator[Console]:
    """A console that still writes to the terminal while `blender_writes_to` sends everything else to a file."""
    with os.fdopen(os.dup(1), "w") as terminal:
        yield Console(file=terminal)


@contextmanager
def blender_writes_to(log_file: Path) -> Iterator[None]:
    """Send the output of this process, that of C code included, to a file within the context."""
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
