"""A board in this process's memory: the twin of the one in Redis, for tests."""

from collections.abc import Mapping

from farm.run.registry.port import Run, WorkerReport


class MemoryBoard:
    """Implements `farm.run.registry.port.Board`."""

    def __init__(self) -> None:
        self._runs: dict[str, Run] = {}
        self._workers: dict[str, WorkerReport] = {}

    def register(self, run: Run) -> Run:
        """See `Board.register`."""
        return self._runs.setdefault(run.key, run)

    def replace(self, run: Run) -> None:
        """See `Board.replace`."""
        self._runs[run.key] = run

    def remove(self, key: str) -> None:
        """See `Board.remove`."""
        self._runs.pop(key, None)

    def runs(self) -> Mapping[str, Run]:
        """See `Board.runs`."""
        return dict(self._runs)

    def report(self, report: WorkerReport) -> None:
        """See `Board.report`."""
        self._workers[report.name] = report

    def sign_off(self, name: str) -> None:
        """See `Board.sign_off`."""
        self._workers.pop(name, None)

    def workers(self) -> tuple[WorkerReport, ...]:
        """See `Board.workers`."""
        return tuple(self._workers[name] for name in sorted(self._workers))
