"""The number of cores that libraries see."""

import os
import subprocess
import sys

import pytest

from worker.service.cores import limit_visible_cores

pytestmark = pytest.mark.skipif(
    not hasattr(os, "sched_getaffinity"), reason="this system can't limit a process's cores"
)


@pytest.mark.parametrize("threads", [0, 1, 10_000])
def test_cores_are_hidden_for_a_while(threads: int) -> None:
    """Within the context libraries see the number asked for, up to all; afterwards they see all again."""
    before = os.sched_getaffinity(0)
    with limit_visible_cores(threads):
        assert len(os.sched_getaffinity(0)) == min(threads or len(before), len(before))
    assert os.sched_getaffinity(0) == before


def test_cores_are_back_after_an_error() -> None:
    """If a library doesn't load, the process still gets all of its cores back."""
    before = os.sched_getaffinity(0)
    with pytest.raises(ImportError), limit_visible_cores(1):
        raise ImportError
    assert os.sched_getaffinity(0) == before


@pytest.mark.blender
def test_blender_starts_no_thread_for_a_hidden_core() -> None:
    """With hidden cores Blender starts fewer threads, and none that keeps a core busy waiting."""
    if len(os.sched_getaffinity(0)) == 1:
        pytest.skip("one core can't be hidden")
    program = (
        "import os, sys\n"
        "from worker.service.cores import limit_visible_cores\n"
        "with limit_visible_cores(int(sys.argv[1])):\n"
        "    import bpy\n"
        "sys.stdout.write(f'threads {len(os.listdir(\"/proc/self/task\"))}\\n')\n"
        "sys.stdout.flush()\n"
        "os._exit(0)\n"
    )
    threads = []
    for seen in ("1", "0"):
        command = [sys.executable, "-c", program, seen]
        printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        threads.append(int(printed.splitlines()[-1].removeprefix("threads ")))
    assert threads[0] < threads[1]
