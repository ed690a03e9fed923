"""Which runs a real worker serves: those of its own store and release; and what the others are told."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import cast

import pytest
import redis

from farm import __version__
from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.quarantine import Quarantine
from farm.dataset.verify import verify
from farm.run.progress import RunHandle, on_disk, with_handle
from farm.run.queue.settings import make_app
from farm.run.registry.port import WorkerReport, WorkerState
from tests.live_farm import LiveFarm, is_once_each, live_farm, wait_for, wait_until_done
from tests.stand_in import stand_in_header
from worker.service.process import _Observer
from worker.service.supervisor import Supervisor

pytestmark = pytest.mark.redis

OTHER_RELEASE = "import runpy, farm; farm.__version__ = '9.9.9'; runpy.run_path({!r}, run_name='__main__')"
"""Program of a stand-in worker of another release."""


@pytest.fixture
def farm(tmp_path: Path, redis_url: str, redis_client: "redis.Redis", worker_command: list[str]) -> Iterator[LiveFarm]:
    """A farm without workers."""
    del redis_client  # this fixture empties Redis
    with live_farm(tmp_path, redis_url, worker_command) as farm:
        yield farm


def told(dataset: Dataset, handle: RunHandle) -> str | None:
    """What `farm status` tells of the run's workers."""
    return with_handle(on_disk(dataset, Completion(dataset).look(), {}), handle).unserved


def test_only_workers_of_its_store_and_release_serve_a_run(farm: LiveFarm, tmp_path: Path) -> None:
    """Equal datasets in two stores never meet; one that has no right worker is told why, and loses nothing by it."""
    header = stand_in_header(far=4)
    one, other = (create_dataset(Destination(str(tmp_path / store), "cables"), header) for store in ("a", "b"))
    handle_of_one, handle = farm.submit(one), farm.submit(other)
    farm.start("of-a", {"store": str(tmp_path / "a")})
    stand_in = str(Path(__file__).parents[2] / "stand_in.py")
    command = [sys.executable, "-P", "-c", OTHER_RELEASE.format(stand_in)]
    farm.start("of-another-release", {"store": str(tmp_path / "b")}, command=command)
    wait_until_done(one)
    wait_for(lambda: len(handle.registry.workers()) == 2 and "release" in (told(other, handle) or ""))
    assert told(other, handle) == (
        f"no worker serves this run: 1 worker of release 9.9.9, it needs {__version__}; "
        "1 worker without this dataset in its --store"
    )
    assert handle.queue.length(handle.run) == 4
    assert len(Completion(other).look()) == 0
    assert handle_of_one.queue.length(handle_of_one.run) == 0
    since = len(farm.starts())
    farm.start("right", {"store": str(tmp_path / "b")})
    wait_until_done(other)
    assert is_once_each(farm.starts(since), other)
    assert verify(other).clean
    assert Quarantine(other).look() == handle.ledger.claims() == {}


def test_watchdog_expects_nothing_of_runs_that_are_not_served(farm: LiveFarm) -> None:
    """Jobs that wait beside an idle worker are a fault of that worker only if it serves their run."""
    handle = farm.submit(farm.dataset("cables", far=2))

    class Idle:
        """A supervisor that has nothing to do."""

        served: tuple[str, ...] = ()
        ticked_s = 0.0

        def report(self) -> WorkerReport:
            """The worker's report."""
            return WorkerReport(name="w@host", state=WorkerState.IDLE)

    idle = Idle()
    observer = _Observer(farm.url, cast(Supervisor, idle), make_app(farm.url))
    assert not observer.observe().jobs_wait
    idle.served = (handle.run.key,)
    assert observer.observe().jobs_wait
