"""Ending processes that lead a group of their own."""

import os
import signal
import subprocess
import time
from collections.abc import Sequence
from contextlib import suppress


def stop(processes: Sequence["subprocess.Popen[bytes]"], grace_s: float) -> None:
    """End processes and their groups: ask them, wait at most `grace_s` seconds for all, then kill what is left."""
    for process in processes:
        _signal_group(process, signal.SIGTERM)
    give_up_s = time.monotonic() + grace_s
    for process in processes:
        with suppress(subprocess.TimeoutExpired):
            process.wait(timeout=max(0.0, give_up_s - time.monotonic()))
    for process in processes:
        _signal_group(process, signal.SIGKILL)
        process.wait()


def _signal_group(process: "subprocess.Popen[bytes]", number: signal.Signals) -> None:
    # A group outlives its leader while a child still runs, so it is signalled whether the leader lives or not.
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, number)
