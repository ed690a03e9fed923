"""The run registry in Redis. Entries that this version of the farm can't read are passed over."""

from collections.abc import Mapping
from typing import cast

import redis
from pydantic import ValidationError

from farm.run.lua import read_script
from farm.run.queue.broker import as_broker_error
from farm.run.registry.port import SEEN_S, Run, WorkerReport

_RUNS = "farm:runs"
_WORKERS = "farm:workers"
_SEEN = "farm:workers:seen"
_RUNS_SEEN = "farm:runs:seen"
_KEEP_S = 30 * 24 * 3600
"""Seconds after which a run that nobody puts up again is forgotten, so that a shared Redis does not fill up."""

_PACKAGE = "farm.run.registry"


class RedisRegistry:
    """Implements `farm.run.registry.port.RunRegistry`.

    Args:
        client: with `decode_responses=True`.
    """

    def __init__(self, client: "redis.Redis") -> None:
        self._client = client
        self._report = client.register_script(read_script(_PACKAGE, "report"))
        self._put = client.register_script(read_script(_PACKAGE, "put"))

    def register(self, run: Run) -> Run:
        """See `RunRegistry.register`."""
        with as_broker_error():
            if self._put(keys=[_RUNS, _RUNS_SEEN], args=[run.key, run.model_dump_json(), _KEEP_S, 0]):
                return run
            present = _read_run(run.key, cast(str | None, self._client.hget(_RUNS, run.key)))
        if present is None:
            self.replace(run)
        return present or run

    def replace(self, run: Run) -> None:
        """See `RunRegistry.replace`."""
        with as_broker_error():
            self._put(keys=[_RUNS, _RUNS_SEEN], args=[run.key, run.model_dump_json(), _KEEP_S, 1])

    def remove(self, key: str) -> None:
        """See `RunRegistry.remove`."""
        with as_broker_error():
            self._client.hdel(_RUNS, key)
            self._client.zrem(_RUNS_SEEN, key)

    def runs(self) -> Mapping[str, Run]:
        """See `RunRegistry.runs`."""
        with as_broker_error():
            found = cast(dict[str, str], self._client.hgetall(_RUNS))
        runs = {key: _read_run(key, text) for key, text in found.items()}
        return {key: run for key, run in runs.items() if run is not None}

    def report(self, report: WorkerReport) -> None:
        """See `RunRegistry.report`."""
        with as_broker_error():
            self._report(keys=[_WORKERS, _SEEN], args=[report.name, report.model_dump_json(), SEEN_S])

    def sign_off(self, name: str) -> None:
        """See `RunRegistry.sign_off`."""
        with as_broker_error():
            self._client.hdel(_WORKERS, name)
            self._client.zrem(_SEEN, name)

    def workers(self) -> tuple[WorkerReport, ...]:
        """See `RunRegistry.workers`."""
        with as_broker_error():
            seconds, _ = self._client.time()
            names = cast(list[str], self._client.zrangebyscore(_SEEN, seconds - SEEN_S, "+inf"))
            texts = cast(list[str | None], self._client.hmget(_WORKERS, sorted(names))) if names else []
        reports = []
        for text in texts:
            try:
                reports.append(WorkerReport.model_validate_json(text or ""))
            except ValidationError:
                continue
        return tuple(reports)


def _read_run(key: str, text: str | None) -> Run | None:
    try:
        run = Run.model_validate_json(text or "")
    except ValidationError:
        return None
    return run if run.key == key else None
