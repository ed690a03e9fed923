"""The board in Redis. What is not written by this version of the farm is passed over."""

from collections.abc import Mapping
from typing import cast

import redis
from pydantic import ValidationError

from farm.run.queue.broker import as_broker_error
from farm.run.registry.port import SEEN_S, Run, WorkerReport

_RUNS = "farm:runs"
_WORKERS = "farm:workers"
_SEEN = "farm:workers:seen"
_RUNS_SEEN = "farm:runs:seen"
_KEEP_S = 30 * 24 * 3600

_PRUNE = (
    "for _, old in ipairs(redis.call('ZRANGEBYSCORE', KEYS[2], '-inf', '(' .. (now - ARGV[3]))) do "
    "redis.call('HDEL', KEYS[1], old) redis.call('ZREM', KEYS[2], old) end "
)
_NOW = "local t = redis.call('TIME') local now = tonumber(t[1]) "

# A notice that nobody renews goes with the next that is put up.
_PUT = (
    _NOW + "local new = redis.call('HEXISTS', KEYS[1], ARGV[1]) == 0 "
    "if new or ARGV[4] == '1' then redis.call('HSET', KEYS[1], ARGV[1], ARGV[2]) end "
    "redis.call('ZADD', KEYS[2], now, ARGV[1]) " + _PRUNE + "if new then return 1 end return 0"
)

# A report that nobody renews goes with the next one of another worker.
_REPORT = (
    _NOW
    + "redis.call('HSET', KEYS[1], ARGV[1], ARGV[2]) redis.call('ZADD', KEYS[2], now, ARGV[1]) "
    + _PRUNE
    + "return 1"
)


class RedisRegistry:
    """Implements `farm.run.registry.port.RunRegistry`.

    Args:
        client: with `decode_responses=True`.
    """

    def __init__(self, client: "redis.Redis") -> None:
        self._client = client
        self._report = client.register_script(_REPORT)
        self._put = client.register_script(_PUT)

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
