"""The ledger in Redis, shared by all workers and coordinators. Times are the Redis server's own."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import cast

import redis

from farm.errors import BrokerError
from farm.job import queue_key
from farm.ledger.port import CLAIM_S, RECENT_COMPLETIONS, RETRY_OWNER, Activity, images_per_hour

KEEP_S = 30 * 24 * 3600
"""What nobody has written to for so long is forgotten, so that a shared Redis does not fill up."""

# A claim is a member of a sorted set, scored with the time at which it lapses, and its owner in a hash beside it.
# Scripts run whole: no other client sees a claim between its check and its change.
_NOW = "local t = redis.call('TIME') local now = t[1] + t[2] / 1e6 "
_OWNER = (
    "local owner = false "
    "local lapses = redis.call('ZSCORE', KEYS[1], ARGV[1]) "
    "if lapses and tonumber(lapses) > now then owner = redis.call('HGET', KEYS[2], ARGV[1]) end "
)
_HOLD = (
    "local function hold(who, seconds) "
    "redis.call('ZADD', KEYS[1], string.format('%.6f', now + seconds), ARGV[1]) "
    "redis.call('HSET', KEYS[2], ARGV[1], who) "
    f"for _, key in ipairs(KEYS) do redis.call('EXPIRE', key, {KEEP_S}) end end "
)
_CLAIM = (
    _NOW + _OWNER + _HOLD + f"if owner and owner ~= ARGV[2] and owner ~= '{RETRY_OWNER}' then return false end "
    "local start = redis.call('HINCRBY', KEYS[3], ARGV[1], 1) hold(ARGV[2], ARGV[3]) return start"
)
_REFRESH = _NOW + _OWNER + _HOLD + "if owner ~= ARGV[2] then return 0 end hold(ARGV[2], ARGV[3]) return 1"
_POSTPONE = _NOW + _OWNER + _HOLD + f"if owner ~= ARGV[2] then return 0 end hold('{RETRY_OWNER}', ARGV[3]) return 1"
_RELEASE = (
    _NOW + _OWNER + "if owner ~= ARGV[2] then return 0 end "
    "redis.call('ZREM', KEYS[1], ARGV[1]) redis.call('HDEL', KEYS[2], ARGV[1]) "
    "if ARGV[3] == '1' then redis.call('HINCRBY', KEYS[3], ARGV[1], -1) end return 1"
)


@contextmanager
def _as_broker_error() -> Iterator[None]:
    try:
        yield
    except redis.RedisError as error:
        raise BrokerError(f"Redis refused or went away: {error}") from error


class RedisLedger:
    """Implements `farm.ledger.port.Ledger`.

    Args:
        client: with `decode_responses=True`.
        dataset: the dataset's name.
        spec_sha256: keeps datasets of one name and different descriptions apart.
    """

    def __init__(self, client: "redis.Redis", dataset: str, spec_sha256: str) -> None:
        self._client = client
        self._prefix = f"farm:{queue_key(dataset, spec_sha256)}"
        self._claim = client.register_script(_CLAIM)
        self._refresh = client.register_script(_REFRESH)
        self._postpone = client.register_script(_POSTPONE)
        self._release = client.register_script(_RELEASE)

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
        with _as_broker_error():
            return cast(int | None, self._claim(keys=self._claim_keys, args=[job_id, owner, ttl_s]))

    def refresh(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> bool:
        """See `Ledger.refresh`."""
        with _as_broker_error():
            return bool(self._refresh(keys=self._claim_keys, args=[job_id, owner, ttl_s]))

    def release(self, job_id: str, owner: str) -> None:
        """See `Ledger.release`."""
        with _as_broker_error():
            self._release(keys=self._claim_keys, args=[job_id, owner, 0])

    def give_back(self, job_id: str, owner: str) -> None:
        """See `Ledger.give_back`."""
        with _as_broker_error():
            self._release(keys=self._claim_keys, args=[job_id, owner, 1])

    def count_trouble(self, job_id: str) -> int:
        """See `Ledger.count_trouble`."""
        with _as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            pipe.hincrby(self._key("troubles"), job_id, 1)
            pipe.expire(self._key("troubles"), KEEP_S)
            return int(pipe.execute()[0])

    def count_absence(self) -> int:
        """See `Ledger.count_absence`."""
        with _as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            pipe.incr(self._key("absences"))
            pipe.expire(self._key("absences"), KEEP_S)
            return int(pipe.execute()[0])

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """See `Ledger.postpone`."""
        with _as_broker_error():
            self._postpone(keys=self._claim_keys, args=[job_id, owner, delay_s])

    def claims(self) -> Mapping[str, str]:
        """See `Ledger.claims`."""
        with _as_broker_error():
            live = cast(list[str], self._client.zrangebyscore(self._key("claims"), f"({self._now():.6f}", "+inf"))
            if not live:
                return {}
            owners = cast(list[str | None], self._client.hmget(self._key("owners"), live))
        return {job_id: owner for job_id, owner in zip(live, owners, strict=True) if owner is not None}

    def record_done(self, job_id: str, picture: str) -> None:
        """See `Ledger.record_done`."""
        with _as_broker_error():
            now = self._now()
            pipe = self._client.pipeline(transaction=True)
            pipe.lpush(self._key("finished"), f"{now:.3f}")
            pipe.ltrim(self._key("finished"), 0, RECENT_COMPLETIONS - 1)
            pipe.expire(self._key("finished"), KEEP_S)
            pipe.set(self._key("last"), picture, ex=KEEP_S)
            for name in ("failures", "starts", "troubles"):
                pipe.hdel(self._key(name), job_id)
            pipe.delete(self._key("absences"))
            pipe.execute()

    def record_failure(self, job_id: str, reason: str) -> None:
        """See `Ledger.record_failure`."""
        with _as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            pipe.hset(self._key("failures"), job_id, reason)
            pipe.expire(self._key("failures"), KEEP_S)
            pipe.execute()

    def failures(self) -> Mapping[str, str]:
        """See `Ledger.failures`."""
        with _as_broker_error():
            return cast(dict[str, str], self._client.hgetall(self._key("failures")))

    def forget_failures(self) -> None:
        """See `Ledger.forget_failures`."""
        failed = list(self.failures())
        with _as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            if failed:
                for name in ("failures", "starts", "troubles"):
                    pipe.hdel(self._key(name), *failed)
            pipe.delete(self._key("absences"))
            pipe.execute()

    def activity(self) -> Activity:
        """See `Ledger.activity`."""
        with _as_broker_error():
            finished = cast(list[str], self._client.lrange(self._key("finished"), 0, -1))
            last = cast(str | None, self._client.get(self._key("last")))
            now = self._now()
        return Activity(
            images_per_hour=images_per_hour([float(moment) for moment in finished], now),
            last_picture=last,
        )
