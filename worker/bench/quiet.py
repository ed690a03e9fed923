"""Keeping Blender's chatter out of a benchmark's table."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from worker.process import send_output_to


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
