"""The claim of a job that runs: renewed while it runs, and checked before anything is written.

A claim is a lease: it lapses unless it is renewed. Its holder knows by its own clock until when no other process can
have it, even if it was stopped in between and thinks that no time has passed. So a worker that was thought dead and
comes back writes nothing.
"""

import logging
import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self

from farm.errors import BrokerError, FarmError
from farm.run.ledger.port import CLAIM_S, Ledger

log = logging.getLogger(__name__)


def _awake_or_asleep_s() -> float:
    """Count seconds that never stand still or go back, also while the machine sleeps; other clocks may rest with it."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


_CLOCK = _awake_or_asleep_s if hasattr(time, "CLOCK_BOOTTIME") else time.monotonic


class LeaseLostError(FarmError):
    """The job belongs to another worker by now, or may belong to one."""


class Lease:
    """Renews a claim from a thread of its own, inside `with`.

    Args:
        ledger: the ledger that holds the claim.
        job_id: the claimed job.
        owner: the process that has claimed it, just now.
        ttl_s: seconds after which the claim lapses unless it is renewed.
        every_s: seconds between two renewals; by default a sixth of `ttl_s`.
        clock: clock that counts seconds, also while the process is stopped or the machine sleeps.
    """

    def __init__(
        self,
        ledger: Ledger,
        job_id: str,
        owner: str,
        *,
        ttl_s: float = CLAIM_S,
        every_s: float | None = None,
        clock: Callable[[], float] = _CLOCK,
    ) -> None:
        self._ledger = ledger
        self._job_id = job_id
        self._owner = owner
        self._ttl_s = ttl_s
        self._every_s = ttl_s / 6 if every_s is None else every_s
        self._clock = clock
        # A tenth less than the ledger counts, since its clock is another one.
        self._until_s = clock() + 0.9 * ttl_s
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._keep_renewing, name=f"heartbeat {job_id}", daemon=True)

    def _keep_renewing(self) -> None:
        while not self._stop.wait(self._every_s):
            try:
                self.renew()
            except BrokerError as error:
                log.warning("claim of %s not renewed: %s", self._job_id, error)
            except LeaseLostError:
                return

    def renew(self) -> None:
        """Ask the ledger for more time.

        Raises:
            LeaseLostError: if the claim is no longer held.
            BrokerError: if the ledger can't be reached.
        """
        asked_s = self._clock()
        if not self._ledger.refresh(self._job_id, self._owner, self._ttl_s):
            self._until_s = float("-inf")
            raise LeaseLostError(f"{self._job_id}: this worker lost its claim, so nothing of it is written")
        self._until_s = max(self._until_s, asked_s + 0.9 * self._ttl_s)

    def check(self) -> None:
        """Make sure that no other process can have the job at this moment.

        Raises:
            LeaseLostError: if another may.
        """
        if self._clock() >= self._until_s:
            raise LeaseLostError(f"{self._job_id}: this worker's claim has lapsed, so nothing of it is written")

    def __enter__(self) -> Self:
        """Start to renew."""
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Stop, and wait for a renewal that is under way."""
        self._stop.set()
        self._thread.join()
