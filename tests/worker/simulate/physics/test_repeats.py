"""Gate 9: the same scene twice."""

import os
import subprocess
import sys

import pytest

from benchmarks.physics.gates import same_bits
from farm.spec.simulation import RodFall
from tests.worker.scenes import make_scene
from worker.simulate.rod.fall import drop_cables

PROGRAM = """
import hashlib
from farm.spec.simulation import RodFall
from tests.worker.scenes import make_scene
from worker.simulate.rod.fall import drop_cables
shapes = drop_cables(make_scene(index=1, ranges={"cable": {"count": [6, 6]}}), RodFall())
digest = hashlib.sha256()
for array in (*shapes.nodes_m, *shapes.speeds_m_s):
    digest.update(array.tobytes())
print(digest.hexdigest(), shapes.steps)
"""


def in_a_process(threads: int) -> str:
    """The result of a pile in a process of its own with this number of threads."""
    environment = {**os.environ, "NUMBA_NUM_THREADS": str(threads), "OMP_NUM_THREADS": str(threads)}
    command = [sys.executable, "-c", PROGRAM]
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout


def test_a_pile_has_the_same_bits_in_every_process_at_any_number_of_threads() -> None:
    """The order of operations is fixed, so that runs with one thread, one again, and two are equal to the last bit."""
    first = in_a_process(1)
    assert len(first) > 64
    assert [in_a_process(1), in_a_process(2)] == [first, first]


@pytest.mark.parametrize("cables", [1, 6])
def test_a_pile_has_the_same_bits_within_a_process(cables: int) -> None:
    """A run leaves nothing that changes the next."""
    scene = make_scene(index=2, ranges={"cable": {"count": [cables, cables]}})
    assert same_bits(drop_cables(scene, RodFall()), drop_cables(scene, RodFall()))
