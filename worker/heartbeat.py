"""Keeping a claim alive while its job runs."""

import logging
import threading
from types import TracebackType
from typing import Self

from farm.errors import BrokerError
from farm.ledger.port import CLAIM_S, Ledger

log = logging.getLogger(__name__)


class Heartbeat:
    """Refreshes a claim from a thread of its own, inside `with`."""

    def __init__(self, ledger: Ledger, job_id: str, owner: str, *, every_s: float = CLAIM_S / 6) -> None:
        self._ledger = ledger
        self._job_id = job_id
        self._owner = owner
        self._every_s = every_s
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._beat, name=f"heartbeat {job_id}", daemon=True)

    def _beat(self) -> None:
        while not self._stop.wait(self._every_s):
            try:
                self._ledger.refresh(self._job_id, self._owner)
            except BrokerError as error:
                # The claim may lapse and the job be made twice, to the same bytes: no reason to stop.
                log.warning("claim of %s not refreshed: %s", self._job_id, error)

    def __enter__(self) -> Self:
        """Start."""
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Stop, and wait for a refresh that is under way."""
        self._stop.set()
        self._thread.join()
