"""A solver that no longer gets on ends the tests with its traceback, instead of holding them up for ever."""

import faulthandler
import os
from collections.abc import Iterator

import pytest

from tests.worker.simulate.physics.rods import line, rod
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

PATIENCE_S = 60
"""Twenty times what the longest of these tests takes, once the solver is compiled."""


@pytest.fixture(scope="session")
def _compiled_solver() -> None:
    """One step, so that no test's patience is spent on the compiler."""
    RodSimulation([rod(line((0, 0, 1), (0.1, 0, 1), 10))], Surroundings(), steps_per_s=1000).advance(1)


@pytest.fixture(scope="session")
def _real_stderr(pytestconfig: pytest.Config) -> Iterator[int]:
    """The stream that is shown; the one that tests write to is captured, and lost with the process."""
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
