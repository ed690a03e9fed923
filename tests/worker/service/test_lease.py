"""Keeping a claim alive, and knowing when another worker may have it."""

import time
from unittest.mock import patch

import pytest

from farm.errors import BrokerError
from tests.doubles.ledger import MemoryLedger
from worker.service.lease import Lease, LeaseLostError

JOB_ID = "far-000001"


class ShortLedger(MemoryLedger):
    """A ledger whose claims last a fifth of a second, and that counts their refreshes."""

    refreshed = 0

    def refresh(self, job_id: str, owner: str, ttl_s: float = 0.2) -> bool:
        """Implement `Ledger.refresh`."""
        self.refreshed += 1
        return super().refresh(job_id, owner, min(ttl_s, 0.2))


class Clock:
    """A clock that the test moves."""

    now_s = 1000.0

    def __call__(self) -> float:
        """The time, in seconds."""
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    """The worker's own clock."""
    return Clock()


@pytest.fixture
def ledger(clock: Clock) -> MemoryLedger:
    """A ledger with the same clock, in which the job is claimed for a minute."""
    ledger = MemoryLedger(clock)
    ledger.claim(JOB_ID, "a:1", ttl_s=60.0)
    return ledger


@pytest.fixture
def claim(ledger: MemoryLedger, clock: Clock) -> Lease:
    """The lease of the claim, whose thread isn't started."""
    return Lease(ledger, JOB_ID, "a:1", ttl_s=60.0, clock=clock)


def wait_for_beats(ledger: ShortLedger, count: int) -> None:
    """Wait until the claim was renewed a number of times."""
    give_up_s = time.monotonic() + 30
    while ledger.refreshed < count:
        assert time.monotonic() < give_up_s
        time.sleep(0.01)


def test_claim_outlives_its_term() -> None:
    """While the thread refreshes it, a claim lives on; when it stops, the claim lapses."""
    ledger = ShortLedger()
    ledger.claim(JOB_ID, "a:1", ttl_s=60.0)
    with Lease(ledger, JOB_ID, "a:1", every_s=0.01):
        wait_for_beats(ledger, 30)
        assert JOB_ID in ledger.claims()
    beats = ledger.refreshed
    time.sleep(0.3)
    assert ledger.refreshed == beats
    assert JOB_ID not in ledger.claims()


def test_beats_on_without_redis(caplog: pytest.LogCaptureFixture) -> None:
    """A Redis that is away for a while doesn't end the job."""
    ledger = ShortLedger()
    calls = []

    def away(*_: object) -> bool:
        calls.append(1)
        raise BrokerError("gone")

    with patch.object(ledger, "refresh", side_effect=away), Lease(ledger, JOB_ID, "a:1", every_s=0.01) as claim:
        give_up_s = time.monotonic() + 30
        while len(calls) < 3:
            assert time.monotonic() < give_up_s
            time.sleep(0.01)
        claim.check()
    assert "not renewed: gone" in caplog.text


def test_lost_claim_is_found_out_by_the_thread() -> None:
    """The next refresh shows that another worker has the claim."""
    ledger = MemoryLedger()
    ledger.claim(JOB_ID, "b:1")
    with Lease(ledger, JOB_ID, "a:1", every_s=0.01) as claim:
        claim._thread.join(30)  # the thread ends when it has found out
        with pytest.raises(LeaseLostError):
            claim.check()
    assert ledger.claims() == {JOB_ID: "b:1"}


def test_lease_is_shorter_than_the_claim(claim: Lease, ledger: MemoryLedger, clock: Clock) -> None:
    """The holder trusts its claim for nine tenths of the term, in which the ledger still has it and nobody writes."""
    clock.now_s += 53.9
    claim.check()
    clock.now_s += 0.2
    with pytest.raises(LeaseLostError, match="lapsed"):
        claim.check()
    assert ledger.claims() == {JOB_ID: "a:1"}


def test_renewed_lease(claim: Lease, clock: Clock) -> None:
    """A renewed lease lasts another term."""
    clock.now_s += 50.0
    claim.renew()
    clock.now_s += 50.0
    claim.check()


def test_lapsed_claim_that_nobody_took(claim: Lease, clock: Clock) -> None:
    """After the term the holder must ask, and continues if no other worker took the job."""
    clock.now_s += 61.0
    with pytest.raises(LeaseLostError):
        claim.check()
    claim.renew()
    claim.check()


def test_claim_of_another_is_not_taken_back(claim: Lease, ledger: MemoryLedger, clock: Clock) -> None:
    """A holder that finds its job claimed by another worker leaves it, for good."""
    clock.now_s += 61.0
    ledger.claim(JOB_ID, "b:1", ttl_s=60.0)
    with pytest.raises(LeaseLostError):
        claim.renew()
    ledger.release(JOB_ID, "b:1")
    with pytest.raises(LeaseLostError):
        claim.check()


@pytest.mark.skipif(not hasattr(time, "CLOCK_BOOTTIME"), reason="this system has no such clock")
def test_lease_lapses_while_the_machine_sleeps(ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch) -> None:
    """The time that a sleeping machine misses counts, though other clocks stand still meanwhile."""
    slept_s = 0.0
    of_system = time.clock_gettime

    def clock_gettime(clock: int) -> float:
        return of_system(clock) + (slept_s if clock == time.CLOCK_BOOTTIME else 0.0)

    monkeypatch.setattr(time, "clock_gettime", clock_gettime)
    claim = Lease(ledger, JOB_ID, "a:1", ttl_s=60.0)
    claim.check()
    slept_s = 61.0
    with pytest.raises(LeaseLostError, match="lapsed"):
        claim.check()


def test_late_answer_is_counted_from_the_question(ledger: MemoryLedger, clock: Clock) -> None:
    """A process that was stopped while it waited for the ledger counts the lease from its question."""

    class Slow(MemoryLedger):
        def refresh(self, job_id: str, owner: str, ttl_s: float = 60.0) -> bool:
            found = ledger.refresh(job_id, owner, ttl_s)
            clock.now_s += 55.0
            return found

    claim = Lease(Slow(), JOB_ID, "a:1", ttl_s=60.0, clock=clock)
    claim.renew()
    with pytest.raises(LeaseLostError):
        claim.check()
