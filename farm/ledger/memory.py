"""A ledger in this process's memory: the twin of the one in Redis, for tests and single-process use."""

import time
from collections import Counter, deque
from collections.abc import Callable, Mapping

from farm.category import Category
from farm.ledger.port import CLAIM_S, RECENT_COMPLETIONS, RETRY_OWNER, Activity, images_per_hour


class MemoryLedger:
    """Implements `farm.ledger.port.Ledger`."""

    def __init__(self, clock: Callable[[], float] = time.time) -> None:
        self._clock = clock
        self._claims: dict[str, tuple[str, float]] = {}
        self._attempts: Counter[str] = Counter()
        self._failures: dict[str, str] = {}
        self._done: Counter[Category] = Counter()
        self._finished_s: deque[float] = deque(maxlen=RECENT_COMPLETIONS)
        self._last_picture: str | None = None

    def claim(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> int | None:
        """See `Ledger.claim`."""
        if self.claims().get(job_id, owner) not in {owner, RETRY_OWNER}:
            return None
        self._claims[job_id] = (owner, self._clock() + ttl_s)
        self._attempts[job_id] += 1
        return self._attempts[job_id]

    def refresh(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> bool:
        """See `Ledger.refresh`."""
        if self.claims().get(job_id) != owner:
            return False
        self._claims[job_id] = (owner, self._clock() + ttl_s)
        return True

    def release(self, job_id: str, owner: str) -> None:
        """See `Ledger.release`."""
        if self.claims().get(job_id) == owner:
            del self._claims[job_id]

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """See `Ledger.postpone`."""
        if self.claims().get(job_id) == owner:
            self._claims[job_id] = (RETRY_OWNER, self._clock() + delay_s)

    def claims(self) -> Mapping[str, str]:
        """See `Ledger.claims`."""
        now = self._clock()
        return {job_id: owner for job_id, (owner, until) in self._claims.items() if until > now}

    def record_done(self, job_id: str, category: Category, picture: str) -> None:
        """See `Ledger.record_done`."""
        self._done[category] += 1
        self._finished_s.append(self._clock())
        self._last_picture = picture
        self._failures.pop(job_id, None)
        self._attempts.pop(job_id, None)

    def record_failure(self, job_id: str, reason: str) -> None:
        """See `Ledger.record_failure`."""
        self._failures[job_id] = reason

    def failures(self) -> Mapping[str, str]:
        """See `Ledger.failures`."""
        return dict(self._failures)

    def forget_failures(self) -> None:
        """See `Ledger.forget_failures`."""
        for job_id in self._failures:
            self._attempts.pop(job_id, None)
        self._failures.clear()

    def activity(self) -> Activity:
        """See `Ledger.activity`."""
        return Activity(
            images_per_hour=images_per_hour(list(self._finished_s), self._clock()),
            last_picture=self._last_picture,
            done=dict(self._done),
        )
