"""A run registry in this process's memory: the twin of the one in Redis, for tests."""

from collections.abc import Mapping

from farm.run.registry.port import Priority, Run, RunState, WorkerReport


class MemoryRegistry:
    """Implements `farm.run.registry.port.RunRegistry`."""

    def __init__(self) -> None:
        self._runs: dict[str, Run] = {}
        self._workers: dict[str, WorkerReport] = {}

    def register(self, run: Run) -> Run:
        """Implement `RunRegistry.register`."""
        return self._runs.setdefault(run.key, run)

    def replace(self, run: Run) -> None:
        """Implement `RunRegistry.replace`."""
        self._runs[run.key] = run

    def change(self, key: str, state: RunState, priority: Priority | None = None) -> bool:
        """Implement `RunRegistry.change`."""
        if key not in self._runs:
            return False
        changes = {"state": state} | ({} if priority is None else {"priority": priority})
        self._runs[key] = self._runs[key].model_copy(update=changes)
        return True

    def remove(self, key: str) -> None:
        """Implement `RunRegistry.remove`."""
        self._runs.pop(key, None)

    def runs(self) -> Mapping[str, Run]:
        """Implement `RunRegistry.runs`."""
        return dict(self._runs)

    def report(self, report: WorkerReport) -> None:
        """Implement `RunRegistry.report`."""
        self._workers[report.name] = report

    def sign_off(self, name: str) -> None:
        """Implement `RunRegistry.sign_off`."""
        self._workers.pop(name, None)

    def workers(self) -> tuple[WorkerReport, ...]:
        """Implement `RunRegistry.workers`."""
        return tuple(self._workers[name] for name in sorted(self._workers))
