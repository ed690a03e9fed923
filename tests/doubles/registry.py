"""A board in this process's memory: the twin of the one in Redis, for tests."""

from collections.abc import Mapping

from farm.run.registry.port import Run, WorkerReport


class MemoryRegistry:
    """Implements `farm.run.registry.port.RunRegistry`."""

    def __init__(self) -> None:
        self._runs: dict[str, Run] = {}
        self._workers: dict[str, WorkerReport] = {}

    def register(self, run: Run) -> Run:
        """See `RunRegistry.register`."""
        return self._runs.setdefault(run.key, run)

    def replace(self, run: Run) -> None:
        """See `RunRegistry.replace`."""
        self._runs[run.key] = run

    def remove(self, key: str) -> None:
        """See `RunRegistry.remove`."""
        self._runs.pop(key, None)

    def runs(self) -> Mapping[str, Run]:
        """See `RunRegistry.runs`."""
        return dict(self._runs)

    def report(self, report: WorkerReport) -> None:
        """See `RunRegistry.report`."""
        self._workers[report.name] = report

    def sign_off(self, name: str) -> None:
        """See `RunRegistry.sign_off`."""
        self._workers.pop(name, None)

    def workers(self) -> tuple[WorkerReport, ...]:
        """See `RunRegistry.workers`."""
        return tuple(self._workers[name] for name in sorted(self._workers))
