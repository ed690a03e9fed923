"""A ledger in this process's memory: the twin of the one in Redis, for tests and single-process use."""

import time
from collections import Counter, deque
from collections.abc import Callable, Mapping

from farm.ledger.port import CLAIM_S, RECENT_COMPLETIONS, RETRY_OWNER, Activity, images_per_hour


class MemoryLedger:
    """Implements `farm.ledger.port.Ledger`."""

    def __init__(self, clock: Callable[[], float] = time.time) -> None:
        self._clock = clock
        self._claims: dict[str, tuple[str, float]] = {}
        self._starts: Counter[str] = Counter()
        self._troubles: Counter[str] = Counter()
        self._absences = 0
        self._failures: dict[str, str] = {}
        self._finished_s: deque[float] = deque(maxlen=RECENT_COMPLETIONS)
        self._last_picture: str | None = None

    def claim(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> int | None:
        """See `Ledger.claim`."""
        if self.claims().get(job_id, owner) not in {owner, RETRY_OWNER}:
            return None
        self._claims[job_id] = (owner, self._clock() + ttl_s)
        self._starts[job_id] += 1
        return self._starts[job_id]

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

    def give_back(self, job_id: str, owner: str) -> None:
        """See `Ledger.give_back`."""
        if self.claims().get(job_id) == owner:
            del self._claims[job_id]
            self._starts[job_id] -= 1

    def count_trouble(self, job_id: str) -> int:
        """See `Ledger.count_trouble`."""
        self._troubles[job_id] += 1
        return self._troubles[job_id]

    def count_absence(self) -> int:
        """See `Ledger.count_absence`."""
        self._absences += 1
        return self._absences

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """See `Ledger.postpone`."""
        if self.claims().get(job_id) == owner:
            self._claims[job_id] = (RETRY_OWNER, self._clock() + delay_s)

    def claims(self) -> Mapping[str, str]:
        """See `Ledger.claims`."""
        now = self._clock()
        return {job_id: owner for job_id, (owner, until) in self._claims.items() if until > now}

    def record_done(self, job_id: str, picture: str) -> None:
        """See `Ledger.record_done`."""
        self._finished_s.append(self._clock())
        self._last_picture = picture
        self._failures.pop(job_id, None)
        self._starts.pop(job_id, None)
        self._troubles.pop(job_id, None)
        self._absences = 0

    def record_failure(self, job_id: str, reason: str) -> None:
        """See `Ledger.record_failure`."""
        self._failures[job_id] = reason

    def failures(self) -> Mapping[str, str]:
        """See `Ledger.failures`."""
        return dict(self._failures)

    def forget_failures(self) -> None:
        """See `Ledger.forget_failures`."""
        for job_id in self._failures:
            self._starts.pop(job_id, None)
            self._troubles.pop(job_id, None)
        self._failures.clear()
        self._absences = 0

    def activity(self) -> Activity:
        """See `Ledger.activity`."""
        return Activity(
            images_per_hour=images_per_hour(list(self._finished_s), self._clock()),
            last_picture=self._last_picture,
        )
