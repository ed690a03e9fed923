"""The ledger in Redis, shared by all workers and coordinators. Times are the Redis server's own."""

from collections.abc import Iterable, Mapping
from typing import cast

import redis

from farm.run.ledger.port import CLAIM_S, RECENT_COMPLETIONS, RETRY_OWNER, Activity, images_per_hour
from farm.run.queue.broker import as_broker_error
from farm.spec.job import queue_key

KEEP_S = 30 * 24 * 3600
"""What nobody has written to for so long is forgotten, so that a shared Redis does not fill up."""

_LONGEST_HOLD_S = max(3600.0, 2 * CLAIM_S)
"""No claim is held for longer, so one that seems to be is of a clock that was set back since: it is void."""

# A claim is a member of a sorted set, scored with the time at which it lapses, and its owner in a hash beside it.
# Scripts run whole: no other client sees a claim between its check and its change.
_NOW = "local t = redis.call('TIME') local now = t[1] + t[2] / 1e6 "
_OWNER = (
    "local owner = false "
    "local lapses = redis.call('ZSCORE', KEYS[1], ARGV[1]) "
    f"if lapses and tonumber(lapses) > now and tonumber(lapses) < now + {_LONGEST_HOLD_S} then "
    "owner = redis.call('HGET', KEYS[2], ARGV[1]) end "
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
# A lapsed claim that nobody has taken is still its owner's.
_MINE = "if redis.call('HGET', KEYS[2], ARGV[1]) ~= ARGV[2] then return 0 end "
_REFRESH = _NOW + _HOLD + _MINE + "hold(ARGV[2], ARGV[3]) return 1"
_POSTPONE = (
    _NOW + _HOLD + _MINE + f"hold('{RETRY_OWNER}', ARGV[3]) redis.call('HINCRBY', KEYS[3], ARGV[1], -1) return 1"
)
_RELEASE = (
    _MINE + "redis.call('ZREM', KEYS[1], ARGV[1]) redis.call('HDEL', KEYS[2], ARGV[1]) "
    "if ARGV[3] == '1' then redis.call('HINCRBY', KEYS[3], ARGV[1], -1) end return 1"
)
# Keys 4 to 8: troubles, logs, absences, finished, last.
_FINISH = (
    _NOW + _MINE + "redis.call('ZREM', KEYS[1], ARGV[1]) "
    "for place = 2, 5 do redis.call('HDEL', KEYS[place], ARGV[1]) end "
    "redis.call('DEL', KEYS[6]) "
    "redis.call('LPUSH', KEYS[7], string.format('%.3f', now)) "
    f"redis.call('LTRIM', KEYS[7], 0, {RECENT_COMPLETIONS - 1}) redis.call('EXPIRE', KEYS[7], {KEEP_S}) "
    f"redis.call('SET', KEYS[8], ARGV[3], 'EX', {KEEP_S}) return 1"
)
_LEAD = (
    "local leader = redis.call('GET', KEYS[1]) if leader and leader ~= ARGV[1] then return 0 end "
    "redis.call('SET', KEYS[1], ARGV[1], 'PX', ARGV[2]) return 1"
)
_RESIGN = "if redis.call('GET', KEYS[1]) == ARGV[1] then redis.call('DEL', KEYS[1]) end return 1"


class RedisLedger:
    """Implements `farm.run.ledger.port.Ledger`.

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
        self._finish = client.register_script(_FINISH)
        self._lead = client.register_script(_LEAD)
        self._resign = client.register_script(_RESIGN)

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
            return cast(int | None, self._claim(keys=self._claim_keys, args=[job_id, owner, ttl_s]))

    def refresh(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> bool:
        """See `Ledger.refresh`."""
        with as_broker_error():
            return bool(self._refresh(keys=self._claim_keys, args=[job_id, owner, ttl_s]))

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

    def count_absence(self) -> int:
        """See `Ledger.count_absence`."""
        with as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            pipe.incr(self._key("absences"))
            pipe.expire(self._key("absences"), KEEP_S)
            return int(pipe.execute()[0])

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """See `Ledger.postpone`."""
        with as_broker_error():
            self._postpone(keys=self._claim_keys, args=[job_id, owner, delay_s])

    def claims(self) -> Mapping[str, str]:
        """See `Ledger.claims`."""
        with as_broker_error():
            now = self._now()
            until = f"({now + _LONGEST_HOLD_S:.6f}"
            live = cast(list[str], self._client.zrangebyscore(self._key("claims"), f"({now:.6f}", until))
            if not live:
                return {}
            owners = cast(list[str | None], self._client.hmget(self._key("owners"), live))
        return {job_id: owner for job_id, owner in zip(live, owners, strict=True) if owner is not None}

    def finish(self, job_id: str, owner: str, picture: str) -> bool:
        """See `Ledger.finish`."""
        more = [self._key(name) for name in ("troubles", "logs", "absences", "finished", "last")]
        with as_broker_error():
            return bool(self._finish(keys=[*self._claim_keys, *more], args=[job_id, owner, picture]))

    def absences(self) -> int:
        """See `Ledger.absences`."""
        with as_broker_error():
            return int(cast(str | None, self._client.get(self._key("absences"))) or 0)

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
        with as_broker_error():
            pipe = self._client.pipeline(transaction=True)
            if forgiven:
                for name in ("starts", "troubles", "logs"):
                    pipe.hdel(self._key(name), *forgiven)
            pipe.delete(self._key("absences"))
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
