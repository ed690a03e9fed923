"""End the tests with a traceback if the solver hangs, instead of holding them up for ever."""

import faulthandler
import os
from collections.abc import Iterator

import pytest

from tests.worker.simulate.physics.rods import line, rod
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

PATIENCE_S = 60
"""Seconds that a test may take: twenty times the longest of these, once the solver is compiled."""


@pytest.fixture(scope="session")
def _compiled_solver() -> None:
    """Make one step first, so that the compiler's time doesn't count as any test's."""
    RodSimulation([rod(line((0, 0, 1), (0.1, 0, 1), 10))], Surroundings(), steps_per_s=1000).advance(1)


@pytest.fixture(scope="session")
def _real_stderr(pytestconfig: pytest.Config) -> Iterator[int]:
    """The original standard error; the one that tests write to is captured and lost with the process."""
    with pytestconfig.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
        stream = os.dup(2)
    yield stream
    os.close(stream)


@pytest.fixture(autouse=True)
def _no_standstill(_compiled_solver: None, _real_stderr: int) -> Iterator[None]:
    # An exception can't be raised into compiled code, so the process ends.
    faulthandler.dump_traceback_later(PATIENCE_S, exit=True, file=_real_stderr)
    yield
    faulthandler.cancel_dump_traceback_later()
