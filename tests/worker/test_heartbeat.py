"""Keeping a claim alive."""

import time
from unittest.mock import patch

import pytest

from farm.errors import BrokerError
from farm.ledger.memory import MemoryLedger
from worker.heartbeat import Heartbeat

JOB_ID = "far-000001"


class ShortLedger(MemoryLedger):
    """Its claims last a fifth of a second, and it counts their refreshments."""

    refreshed = 0

    def refresh(self, job_id: str, owner: str, ttl_s: float = 0.2) -> bool:
        """See `Ledger.refresh`."""
        self.refreshed += 1
        return super().refresh(job_id, owner, min(ttl_s, 0.2))


def wait_for_beats(ledger: ShortLedger, count: int) -> None:
    """Wait until the claim was refreshed so often."""
    give_up_s = time.monotonic() + 30
    while ledger.refreshed < count:
        assert time.monotonic() < give_up_s
        time.sleep(0.01)


def test_claim_outlives_its_term() -> None:
    """While the heart beats, a claim lives on; when it stops, the claim lapses."""
    ledger = ShortLedger()
    ledger.claim(JOB_ID, "a:1", ttl_s=0.2)
    with Heartbeat(ledger, JOB_ID, "a:1", every_s=0.01):
        wait_for_beats(ledger, 30)
        assert JOB_ID in ledger.claims()
    beats = ledger.refreshed
    time.sleep(0.3)
    assert ledger.refreshed == beats
    assert JOB_ID not in ledger.claims()


def test_beats_on_without_redis(caplog: pytest.LogCaptureFixture) -> None:
    """A Redis that is away for a while does not end the job."""
    ledger = ShortLedger()
    away = patch.object(MemoryLedger, "refresh", side_effect=BrokerError("gone"))
    with away, Heartbeat(ledger, JOB_ID, "a:1", every_s=0.01):
        wait_for_beats(ledger, 3)
    assert "not refreshed: gone" in caplog.text
