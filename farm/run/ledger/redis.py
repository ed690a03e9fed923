"""The ledger in Redis, shared by all workers and coordinators. Times are the Redis server's own."""

from collections.abc import Iterable, Mapping
from typing import cast

import redis

from farm.run.ledger.port import CLAIM_S, RECENT_COMPLETIONS, RETRY_OWNER, Activity, images_per_hour
from farm.run.lua import read_script
from farm.run.queue.broker import as_broker_error

KEEP_S = 30 * 24 * 3600
"""Seconds after the last write until Redis forgets a dataset's keys, so that a shared Redis does not fill up."""

_LONGEST_CLAIM_S = max(3600.0, 2 * CLAIM_S)
"""Longest time in seconds for which a claim is made. A claim that lapses later is void: the clock was set back."""

_PACKAGE = "farm.run.ledger"


class RedisLedger:
    """Implements `farm.run.ledger.port.Ledger`.

    Args:
        client: with `decode_responses=True`.
        run_key: keeps runs apart; see `farm.spec.job.queue_key`.
    """

    def __init__(self, client: "redis.Redis", run_key: str) -> None:
        self._client = client
        self._prefix = f"farm:{run_key}"
        self._claim = client.register_script(read_script(_PACKAGE, "claim"))
        self._refresh = client.register_script(read_script(_PACKAGE, "refresh"))
        self._postpone = client.register_script(read_script(_PACKAGE, "postpone"))
        self._release = client.register_script(read_script(_PACKAGE, "release"))
        self._finish = client.register_script(read_script(_PACKAGE, "finish"))
        self._lead = client.register_script(read_script(_PACKAGE, "lead"))
        self._resign = client.register_script(read_script(_PACKAGE, "resign"))

    def _key(self, name: str) -> str:
        return f"{self._prefix}:{name}"

    @property
    def _claim_keys(self) -> list[str]:
        return [self._key("claims"), self._key("owners"), self._key("starts")]

    def _now(self) -> float:
        seconds, microseconds = self._client.time()
        return seconds + microseconds / 1e6

    def claim(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> int | None:
        """See `Ledger.claim`."""
        with as_broker_error():
            arguments: list[str | float] = [job_id, owner, ttl_s, RETRY_OWNER, _LONGEST_CLAIM_S, KEEP_S]
            return cast(int | None, self._claim(keys=self._claim_keys, args=arguments))

    def refresh(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> bool:
        """See `Ledger.refresh`."""
        with as_broker_error():
            return bool(self._refresh(keys=self._claim_keys, args=[job_id, owner, ttl_s, KEEP_S]))

    def release(self, job_id: str, owner: str) -> None:
        """See `Ledger.release`."""
        with as_broker_error():
            self._release(keys=self._claim_keys, args=[job_id, owner, 0])

    def give_back(self, job_id: str, owner: str) -> None:
        """See `Ledger.give_back`."""
        with as_broker_error():
            self._release(keys=self._claim_keys, args=[job_id, owner, 1])

    def count_trouble(self, job_id: str) -> int:
        """See `Ledger.count_trouble`."""
        with as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            pipe.hincrby(self._key("troubles"), job_id, 1)
            pipe.expire(self._key("troubles"), KEEP_S)
            return int(pipe.execute()[0])

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """See `Ledger.postpone`."""
        with as_broker_error():
            self._postpone(keys=self._claim_keys, args=[job_id, owner, delay_s, RETRY_OWNER, KEEP_S])

    def claims(self) -> Mapping[str, str]:
        """See `Ledger.claims`."""
        with as_broker_error():
            now = self._now()
            until = f"({now + _LONGEST_CLAIM_S:.6f}"
            live = cast(list[str], self._client.zrangebyscore(self._key("claims"), f"({now:.6f}", until))
            if not live:
                return {}
            owners = cast(list[str | None], self._client.hmget(self._key("owners"), live))
        return {job_id: owner for job_id, owner in zip(live, owners, strict=True) if owner is not None}

    def finish(self, job_id: str, owner: str, picture: str) -> bool:
        """See `Ledger.finish`."""
        more = [self._key(name) for name in ("troubles", "logs", "finished", "last")]
        arguments: list[str | float] = [job_id, owner, picture, RECENT_COMPLETIONS, KEEP_S]
        with as_broker_error():
            return bool(self._finish(keys=[*self._claim_keys, *more], args=arguments))

    def keep_log(self, job_id: str, text: str) -> None:
        """See `Ledger.keep_log`."""
        with as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            pipe.hset(self._key("logs"), job_id, text)
            pipe.expire(self._key("logs"), KEEP_S)
            pipe.execute()

    def log_of(self, job_id: str) -> str:
        """See `Ledger.log_of`."""
        with as_broker_error():
            return cast(str | None, self._client.hget(self._key("logs"), job_id)) or ""

    def forgive(self, job_ids: Iterable[str]) -> None:
        """See `Ledger.forgive`."""
        forgiven = list(job_ids)
        if not forgiven:
            return
        with as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            for name in ("starts", "troubles", "logs"):
                pipe.hdel(self._key(name), *forgiven)
            pipe.execute()

    def lead(self, owner: str, ttl_s: float) -> bool:
        """See `Ledger.lead`."""
        with as_broker_error():
            return bool(self._lead(keys=[self._key("leader")], args=[owner, max(1, round(ttl_s * 1000))]))

    def leader(self) -> str | None:
        """See `Ledger.leader`."""
        with as_broker_error():
            return cast(str | None, self._client.get(self._key("leader")))

    def resign(self, owner: str) -> None:
        """See `Ledger.resign`."""
        with as_broker_error():
            self._resign(keys=[self._key("leader")], args=[owner])

    def add_figures(self, figures: Mapping[str, float]) -> None:
        """See `Ledger.add_figures`."""
        with as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            for name, value in figures.items():
                pipe.hincrbyfloat(self._key("figures"), name, value)
            pipe.expire(self._key("figures"), KEEP_S)
            pipe.execute()

    def figures(self) -> Mapping[str, float]:
        """See `Ledger.figures`."""
        with as_broker_error():
            found = cast(dict[str, str], self._client.hgetall(self._key("figures")))
        return {name: float(value) for name, value in found.items()}

    def activity(self) -> Activity:
        """See `Ledger.activity`."""
        with as_broker_error():
            finished = cast(list[str], self._client.lrange(self._key("finished"), 0, -1))
            last = cast(str | None, self._client.get(self._key("last")))
            now = self._now()
        return Activity(
            images_per_hour=images_per_hour([float(moment) for moment in finished], now),
            last_picture=last,
        )
