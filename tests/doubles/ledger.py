"""A ledger in this process's memory: the twin of the one in Redis, for tests and single-process use."""

import time
from collections import Counter, deque
from collections.abc import Callable, Iterable, Mapping

from farm.run.ledger.port import CLAIM_S, RECENT_COMPLETIONS, RETRY_OWNER, Activity, images_per_hour


class MemoryLedger:
    """Implements `farm.run.ledger.port.Ledger`."""

    def __init__(self, clock: Callable[[], float] = time.time) -> None:
        self._clock = clock
        self._claims: dict[str, tuple[str, float]] = {}
        self._starts: Counter[str] = Counter()
        self._troubles: Counter[str] = Counter()
        self._logs: dict[str, str] = {}
        self._leader: tuple[str, float] | None = None
        self._figures: Counter[str] = Counter()
        self._finished_s: deque[float] = deque(maxlen=RECENT_COMPLETIONS)
        self._last_picture: str | None = None

    def claim(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> int | None:
        """Implement `Ledger.claim`."""
        if self.claims().get(job_id, owner) not in {owner, RETRY_OWNER}:
            return None
        self._claims[job_id] = (owner, self._clock() + ttl_s)
        self._starts[job_id] += 1
        return self._starts[job_id]

    def refresh(self, job_id: str, owner: str, ttl_s: float = CLAIM_S) -> bool:
        """Implement `Ledger.refresh`."""
        if not self._holds(job_id, owner):
            return False
        self._claims[job_id] = (owner, self._clock() + ttl_s)
        return True

    def _holds(self, job_id: str, owner: str) -> bool:
        # A lapsed claim that nobody has taken is still its owner's.
        return job_id in self._claims and self._claims[job_id][0] == owner

    def release(self, job_id: str, owner: str) -> None:
        """Implement `Ledger.release`."""
        if self._holds(job_id, owner):
            del self._claims[job_id]

    def give_back(self, job_id: str, owner: str) -> None:
        """Implement `Ledger.give_back`."""
        if self._holds(job_id, owner):
            del self._claims[job_id]
            self._starts[job_id] -= 1

    def postpone(self, job_id: str, owner: str, delay_s: float) -> None:
        """Implement `Ledger.postpone`."""
        if self._holds(job_id, owner):
            self._claims[job_id] = (RETRY_OWNER, self._clock() + delay_s)
            self._starts[job_id] -= 1

    def claims(self) -> Mapping[str, str]:
        """Implement `Ledger.claims`."""
        now = self._clock()
        return {job_id: owner for job_id, (owner, until) in self._claims.items() if until > now}

    def finish(self, job_id: str, owner: str, picture: str) -> bool:
        """Implement `Ledger.finish`."""
        if not self._holds(job_id, owner):
            return False
        del self._claims[job_id]
        self._finished_s.append(self._clock())
        self._last_picture = picture
        self.forgive([job_id])
        return True

    def count_trouble(self, job_id: str) -> int:
        """Implement `Ledger.count_trouble`."""
        self._troubles[job_id] += 1
        return self._troubles[job_id]

    def keep_log(self, job_id: str, text: str) -> None:
        """Implement `Ledger.keep_log`."""
        self._logs[job_id] = text

    def log_of(self, job_id: str) -> str:
        """Implement `Ledger.log_of`."""
        return self._logs.get(job_id, "")

    def forgive(self, job_ids: Iterable[str]) -> None:
        """Implement `Ledger.forgive`."""
        for job_id in job_ids:
            for counted in (self._starts, self._troubles, self._logs):
                counted.pop(job_id, None)

    def lead(self, owner: str, ttl_s: float) -> bool:
        """Implement `Ledger.lead`."""
        if self.leader() not in {None, owner}:
            return False
        self._leader = (owner, self._clock() + ttl_s)
        return True

    def leader(self) -> str | None:
        """Implement `Ledger.leader`."""
        return self._leader[0] if self._leader is not None and self._leader[1] > self._clock() else None

    def resign(self, owner: str) -> None:
        """Implement `Ledger.resign`."""
        if self.leader() == owner:
            self._leader = None

    def add_figures(self, figures: Mapping[str, float]) -> None:
        """Implement `Ledger.add_figures`."""
        self._figures.update(figures)

    def figures(self) -> Mapping[str, float]:
        """Implement `Ledger.figures`."""
        return dict(self._figures)

    def activity(self) -> Activity:
        """Implement `Ledger.activity`."""
        return Activity(
            images_per_hour=images_per_hour(list(self._finished_s), self._clock()),
            last_picture=self._last_picture,
        )
