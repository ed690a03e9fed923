"""A whole farm with Redis behind a proxy, workers and a coordinator, and with surroundings that can be spoilt."""

import signal
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.paths import manifest_folder
from farm.errors import IncompleteError
from farm.run.queue.broker import BROKER_VARIABLE
from farm.run.worker_settings import DeviceChoice, RendererSettings, WorkerSettings
from farm.spec.header import DatasetHeader
from tests.chaos.clock import WrongClock, find_faketime
from tests.chaos.disk import SmallDisk, small_disk
from tests.chaos.hang import HangingStore, compile_library, join_environments
from tests.chaos.manifest_watch import ManifestWatch
from tests.chaos.proxy import Proxy
from tests.chaos.redis_service import RedisService
from tests.chaos.service import Service

CLAIM_S = 3.0
"""Term of a claim, seconds: so short that a stopped worker loses its own within seconds."""

_END_S = 20.0
_DISK_MIB = 24
_MIN_FREE_MIB = 1


@dataclass(frozen=True, slots=True)
class Plan:
    """The plan of a farm.

    Attributes:
        dataset: name of the dataset and of the scenario.
        header: header of the dataset.
        worker: program of a worker.
        workers: number of workers.
        environment: environment variables of the workers, in addition to those of this process.
        with_clock: whether the processes use a clock that can be set wrong.
        with_disk: whether the store is on a small disk of its own.
        with_hang: whether the store can be made to hang.
    """

    dataset: str
    header: DatasetHeader
    worker: Sequence[str]
    workers: int
    environment: Mapping[str, str] = field(default_factory=dict)
    with_clock: bool = False
    with_disk: bool = False
    with_hang: bool = False


class FarmUnderTest:
    """All parts of a running farm. Faults act on them; `supervise`, called often, restarts those that fail."""

    def __init__(
        self,
        root: Path,
        plan: Plan,
        proxy: Proxy,
        redis: RedisService,
        clock: WrongClock | None,
        hanging: HangingStore | None,
    ) -> None:
        self.root = root
        self.plan = plan
        self.proxy = proxy
        self.redis = redis
        self.clock = clock
        self.hanging = hanging
        self.disk: SmallDisk | None = None
        self.known_messages: dict[str, tuple[str, str]] = {}  # by job id: the key of the list, and a message
        self.journal = root / "starts.txt"
        self.store = root / "store"
        self.logs = root / "logs"
        self.folder = self.store / plan.dataset
        shared = join_environments(
            {BROKER_VARIABLE: proxy.url, "FARM_CLAIM_S": str(CLAIM_S)},
            clock.environment() if clock else {},
            hanging.environment() if hanging else {},
        )
        of_workers = {**shared, **plan.environment, "STAND_IN_STARTS": str(self.journal)}
        self.workers = [
            Service(name, self._worker_command(name), of_workers, self.logs / f"{name}.out")
            for name in (f"{plan.dataset}-{number}" for number in range(1, plan.workers + 1))
        ]
        self.coordinator = Service(
            "coordinator",
            [self._python, "-P", "-m", "farm", "watch", str(self.folder)],
            shared,
            self.logs / "coordinator.out",
            final_codes=frozenset({0, IncompleteError.exit_code}),
        )
        self.dataset: Dataset
        self.manifests: ManifestWatch

    @property
    def _python(self) -> str:
        return self.plan.worker[0]

    def _worker_command(self, name: str) -> list[str]:
        settings = WorkerSettings(
            store=str(self.store),
            name=name,
            logs=self.logs,
            renderer=RendererSettings(device=DeviceChoice.CPU, threads=1),
            min_free_mib=_MIN_FREE_MIB,
        )
        return [*self.plan.worker, *settings.serve_arguments()]

    @property
    def services(self) -> list[Service]:
        """The supervised services."""
        return [*self.workers, self.coordinator]

    def supervise(self) -> None:
        """Restart the services that failed."""
        for service in self.services:
            service.supervise()

    def end(self) -> list[str]:
        """Ask workers and coordinator to end.

        Returns:
            The names of those that didn't end when asked.
        """
        for service in self.services:
            service.send(signal.SIGTERM)
        return [service.name for service in self.services if not service.ended_within(_END_S)]


@contextmanager
def farm_under_test(root: Path, plan: Plan) -> Iterator[FarmUnderTest]:
    """Run a farm within the context; afterwards nothing that it started is left.

    Args:
        root: a new folder for all files of the farm. Its path is in the arguments of each of the farm's processes.
        plan: plan of the farm.

    Raises:
        OSError: if this machine lacks a means that `tests.chaos.means` asks for.
    """
    (root / "store").mkdir(parents=True)
    with ExitStack() as stack:
        clock = _clock(root) if plan.with_clock else None
        # It is outside the root, since a socket's path must be short.
        socket = Path(stack.enter_context(TemporaryDirectory(prefix="farm-", dir="/tmp"))) / "redis.sock"
        proxy = stack.enter_context(Proxy(socket))
        environment = clock.environment() if clock else {}
        redis = RedisService(root / "redis", socket, environment, root / "logs" / "redis.out")
        stack.callback(redis.client.close)
        farm = FarmUnderTest(root, plan, proxy, redis, clock, _hanging(root) if plan.with_hang else None)
        if plan.with_disk:
            disk = stack.enter_context(small_disk(farm.store, _DISK_MIB))
            if isinstance(disk, str):
                raise OSError(disk)
            farm.disk = disk
        farm.dataset = create_dataset(Destination(str(farm.store), plan.dataset), plan.header)
        quotas = plan.header.spec.quotas
        folders = [farm.folder / manifest_folder(category) for category, quota in quotas.items() if quota]
        farm.manifests = stack.enter_context(ManifestWatch(folders))
        stack.callback(redis.kill)
        redis.start()
        for service in farm.services:
            stack.callback(service.kill)
            service.start()
        yield farm


def _hanging(root: Path) -> HangingStore:
    library = compile_library(root)
    if isinstance(library, str):
        raise OSError(library)
    return HangingStore(library, root / "store", root / "away")


def _clock(root: Path) -> WrongClock:
    library = find_faketime()
    if library is None:
        raise OSError("libfaketime is not installed")
    return WrongClock(library, root / "clock")
