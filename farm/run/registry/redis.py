"""The run registry in Redis. Entries that this release of the farm can't read are passed over, and left as they are."""

import json
from collections.abc import Mapping
from typing import Any, cast

import redis
from pydantic import ValidationError

from farm.errors import ConflictError
from farm.run.lua import read_script
from farm.run.queue.broker import as_broker_error
from farm.run.registry.port import SEEN_S, Priority, Run, RunState, WorkerReport

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
            if self._put(keys=[_RUNS, _RUNS_SEEN], args=[run.key, run.encode(), _KEEP_S, 0]):
                return run
            text = cast(str | None, self._client.hget(_RUNS, run.key))
        if text is None:
            return run  # taken down in between; the next look puts it up again
        present = _read_run(run.key, text)
        if present is None:
            raise _unreadable(run.key)
        return present

    def replace(self, run: Run) -> None:
        """See `RunRegistry.replace`."""
        with as_broker_error():
            self._put(keys=[_RUNS, _RUNS_SEEN], args=[run.key, run.encode(), _KEEP_S, 1])

    def change(self, key: str, state: RunState, priority: Priority | None = None) -> bool:
        """See `RunRegistry.change`."""
        changes = {"state": state.value} | ({} if priority is None else {"priority": priority.value})

        def change(pipe: Any) -> Any:
            text = pipe.hget(_RUNS, key)
            if text is None:
                return False
            if _read_run(key, text) is None:
                raise _unreadable(key)
            pipe.multi()
            pipe.hset(_RUNS, key, json.dumps(json.loads(text) | changes))
            return True

        with as_broker_error():
            # Run again if another client changes an entry meanwhile.
            return bool(cast(Any, self._client).transaction(change, _RUNS, value_from_callable=True))

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


def _unreadable(key: str) -> ConflictError:
    return ConflictError(
        f"{key}: another release of the farm has registered this run, in a form that can't be read here; it is left as "
        "it is: use that release, or farm submit to replace it"
    )


def _read_run(key: str, text: str | None) -> Run | None:
    try:
        run = Run.model_validate_json(text or "")
    except ValidationError:
        return None
    return run if run.key == key else None
