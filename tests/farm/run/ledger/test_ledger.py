"""One suite over the ledger in memory and the one in Redis."""

import time

import pytest
import redis

from farm.run.ledger.owner import is_gone, live_claims, this_process
from farm.run.ledger.port import RETRY_OWNER, Ledger, images_per_hour
from farm.run.ledger.redis import KEEP_S, RedisLedger
from tests.doubles.ledger import MemoryLedger


@pytest.fixture(params=["memory", pytest.param("redis", marks=pytest.mark.redis)])
def ledger(request: pytest.FixtureRequest) -> Ledger:
    """An empty ledger."""
    if request.param == "memory":
        return MemoryLedger()
    return RedisLedger(request.getfixturevalue("redis_client"), "cables:000000000000")


def wait_until_free(ledger: Ledger, job_id: str) -> None:
    """Wait for a claim to lapse."""
    give_up_s = time.monotonic() + 10
    while job_id in ledger.claims():
        assert time.monotonic() < give_up_s
        time.sleep(0.01)


def test_first_claim(ledger: Ledger) -> None:
    """The first to claim a job gets it, for its first attempt."""
    assert ledger.claim("far-000001", "a:1") == 1
    assert ledger.claims() == {"far-000001": "a:1"}


def test_second_owner_is_refused(ledger: Ledger) -> None:
    """A claimed job is refused to others, and the refusal spends no attempt."""
    ledger.claim("far-000001", "a:1")
    assert ledger.claim("far-000001", "b:1") is None
    ledger.release("far-000001", "a:1")
    assert ledger.claim("far-000001", "b:1") == 2


def test_owner_may_claim_again(ledger: Ledger) -> None:
    """The owner's second claim is its next attempt."""
    ledger.claim("far-000001", "a:1")
    assert ledger.claim("far-000001", "a:1") == 2


def test_claim_lapses(ledger: Ledger) -> None:
    """A claim that isn't refreshed becomes free."""
    ledger.claim("far-000001", "a:1", ttl_s=0.05)
    wait_until_free(ledger, "far-000001")
    assert ledger.claim("far-000001", "b:1") == 2


def test_refresh_holds(ledger: Ledger) -> None:
    """A refreshed claim outlives its first term."""
    ledger.claim("far-000001", "a:1", ttl_s=0.5)
    assert ledger.refresh("far-000001", "a:1", ttl_s=60)
    time.sleep(0.6)
    assert "far-000001" in ledger.claims()


def test_refresh_of_a_lost_claim(ledger: Ledger) -> None:
    """Neither another's claim nor a free one can be refreshed."""
    assert not ledger.refresh("far-000001", "a:1")
    ledger.claim("far-000001", "b:1")
    assert not ledger.refresh("far-000001", "a:1")


def test_release_by_another(ledger: Ledger) -> None:
    """Only the owner can release a claim."""
    ledger.claim("far-000001", "a:1")
    ledger.release("far-000001", "b:1")
    assert ledger.claims() == {"far-000001": "a:1"}


def test_postponed_job_is_on_its_way(ledger: Ledger) -> None:
    """A postponed job counts as claimed, anyone may take it over, and its earlier start doesn't count."""
    ledger.claim("far-000001", "a:1")
    ledger.postpone("far-000001", "a:1", 60)
    assert ledger.claims() == {"far-000001": RETRY_OWNER}
    assert ledger.claim("far-000001", "b:1") == 1
    ledger.postpone("far-000001", "a:1", 60)
    assert ledger.claims() == {"far-000001": "b:1"}


def test_postponed_job_survives_the_release(ledger: Ledger) -> None:
    """The former owner's release does not touch what it has postponed."""
    ledger.claim("far-000001", "a:1")
    ledger.postpone("far-000001", "a:1", 60)
    ledger.release("far-000001", "a:1")
    assert "far-000001" in ledger.claims()


def test_start_that_is_given_back(ledger: Ledger) -> None:
    """A job that an unfit worker gives back was never started; a job that another holds isn't affected."""
    ledger.claim("far-000001", "a:1")
    ledger.give_back("far-000001", "b:1")
    assert "far-000001" in ledger.claims()
    ledger.give_back("far-000001", "a:1")
    assert ledger.claims() == {}
    assert ledger.claim("far-000001", "b:1") == 1


def test_troubles_are_counted_apart(ledger: Ledger) -> None:
    """Failures that may pass are counted by job, and forgotten with its end or when it is forgiven."""
    ledger.claim("far-000001", "a:1")
    assert [ledger.count_trouble("far-000001") for _ in range(2)] == [1, 2]
    assert ledger.count_trouble("far-000002") == 1
    ledger.finish("far-000001", "a:1", "picture")
    ledger.forgive(["far-000002"])
    assert ledger.count_trouble("far-000001") == ledger.count_trouble("far-000002") == 1


def test_forgiven_job_begins_anew(ledger: Ledger) -> None:
    """Starts, troubles and log of a forgiven job are forgotten, those of others are not."""
    for job_id in ("far-000001", "far-000002"):
        ledger.claim(job_id, "a:1")
        ledger.count_trouble(job_id)
        ledger.keep_log(job_id, "the end")
    ledger.forgive(["far-000001"])
    assert ledger.claim("far-000001", "a:1") == ledger.count_trouble("far-000001") == 1
    assert ledger.log_of("far-000001") == ""
    assert ledger.claim("far-000002", "a:1") == ledger.count_trouble("far-000002") == 2
    assert ledger.log_of("far-000002") == "the end"


@pytest.mark.redis
def test_nothing_stays_for_ever(redis_client: "redis.Redis") -> None:
    """Every key of a ledger lapses."""
    ledger = RedisLedger(redis_client, "cables:000000000000")
    for job_id in ("far-000001", "far-000002"):
        ledger.claim(job_id, "a:1")
    ledger.count_trouble("far-000001")
    ledger.keep_log("far-000001", "the end")
    ledger.finish("far-000002", "a:1", "picture")
    ledger.lead("a:1", 60)
    ledger.add_figures({"images:far": 1})
    keys = redis_client.keys()
    assert isinstance(keys, list)
    assert len(keys) == 9
    assert all(0 < int(str(redis_client.ttl(key))) <= KEEP_S for key in keys)


def test_newest_picture(ledger: Ledger) -> None:
    """A finished job leaves its picture's path."""
    ledger.claim("far-000001", "a:1")
    assert ledger.finish("far-000001", "a:1", "far/images/far-000001.png")
    assert ledger.activity().last_picture == "far/images/far-000001.png"


def test_finished_job_is_free(ledger: Ledger) -> None:
    """A finished job has no owner, and its starts count from one again."""
    ledger.claim("far-000001", "a:1")
    ledger.finish("far-000001", "a:1", "picture")
    assert ledger.claims() == {}
    assert ledger.claim("far-000001", "b:1") == 1


@pytest.mark.parametrize("holder", [None, "b:1"])
def test_only_the_owner_finishes(ledger: Ledger, holder: str | None) -> None:
    """A worker that has lost a claim finishes nothing, and takes nothing from the present owner."""
    ledger.claim("far-000001", "a:1")
    ledger.release("far-000001", "a:1")
    if holder:
        ledger.claim("far-000001", holder)
    before = ledger.claims()
    assert not ledger.finish("far-000001", "a:1", "picture")
    assert ledger.claims() == before
    assert ledger.activity().last_picture is None


def test_log_is_kept(ledger: Ledger) -> None:
    """The last log of a job is returned, and an empty one for a job without a log."""
    ledger.keep_log("far-000001", "first")
    ledger.keep_log("far-000001", "second")
    assert ledger.log_of("far-000001") == "second"
    assert ledger.log_of("far-000002") == ""


def test_one_leads(ledger: Ledger) -> None:
    """The first to ask leads and may go on leading; others are refused."""
    assert ledger.leader() is None
    assert ledger.lead("a:1", 60)
    assert ledger.lead("a:1", 60)
    assert not ledger.lead("b:1", 60)
    assert ledger.leader() == "a:1"


def test_leadership_is_resigned(ledger: Ledger) -> None:
    """Only the leader resigns, and then another may lead."""
    ledger.lead("a:1", 60)
    ledger.resign("b:1")
    assert ledger.leader() == "a:1"
    ledger.resign("a:1")
    assert ledger.leader() is None
    assert ledger.lead("b:1", 60)


def test_leadership_lapses(ledger: Ledger) -> None:
    """A leader that isn't heard of is replaced."""
    ledger.lead("a:1", 0.05)
    give_up_s = time.monotonic() + 10
    while not ledger.lead("b:1", 60):
        assert time.monotonic() < give_up_s
        time.sleep(0.01)
    assert ledger.leader() == "b:1"


def test_figures_add_up(ledger: Ledger) -> None:
    """Figures grow by the added amounts, each by itself."""
    assert ledger.figures() == {}
    ledger.add_figures({"images:far": 1, "seconds:render": 1.5})
    ledger.add_figures({"images:far": 1})
    assert ledger.figures() == {"images:far": 2, "seconds:render": 1.5}


@pytest.mark.redis
def test_claim_of_a_clock_that_was_set_back(redis_client: "redis.Redis") -> None:
    """A claim that would last for days, after the server's clock was set back, holds nobody up."""
    ledger = RedisLedger(redis_client, "cables:000000000000")
    ledger.claim("far-000001", "a:1", ttl_s=3 * 24 * 3600)
    assert ledger.claims() == {}
    assert ledger.claim("far-000001", "b:1") == 2
    assert ledger.claims() == {"far-000001": "b:1"}


def test_no_rate_at_first(ledger: Ledger) -> None:
    """An empty ledger has neither a rate nor a picture."""
    activity = ledger.activity()
    assert activity.images_per_hour is None
    assert activity.last_picture is None


def test_rate_over_recent_completions() -> None:
    """Eleven pictures at even steps of six seconds make six hundred an hour; older ones don't count."""
    finished = [1000.0 + 6.0 * step for step in range(11)]
    assert images_per_hour([*finished, -9999.0], 1060.0) == pytest.approx(600.0)


@pytest.mark.redis
def test_datasets_are_apart(redis_client: object) -> None:
    """Two descriptions under one name share nothing."""
    one = RedisLedger(redis_client, "cables:000000000000")  # type: ignore[arg-type]  # a fixture's value
    other = RedisLedger(redis_client, "cables:111111111111")  # type: ignore[arg-type]  # a fixture's value
    one.claim("far-000001", "a:1")
    assert other.claims() == {}


def test_ended_process_is_gone() -> None:
    """A process of this host that has ended is gone; this one isn't, nor is one of which nothing is known."""
    host = this_process().partition(":")[0]
    assert is_gone(f"{host}:{2**22 + 1}")
    assert not is_gone(this_process())
    assert not is_gone("elsewhere:1")


def test_claim_of_an_ended_process_is_released() -> None:
    """A claim of an ended process is released."""
    ledger = MemoryLedger()
    host = this_process().partition(":")[0]
    ledger.claim("far-000001", f"{host}:{2**22 + 1}")
    ledger.claim("far-000002", this_process())
    assert live_claims(ledger) == {"far-000002": this_process()}
    assert ledger.claims() == {"far-000002": this_process()}


def test_lapsed_claim_can_be_given_back(ledger: Ledger) -> None:
    """The owner of a lapsed claim may still give it back, and the start with it."""
    ledger.claim("far-000001", "a:1", ttl_s=0.0)
    ledger.give_back("far-000001", "a:1")
    assert ledger.claim("far-000001", "b:1") == 1


def test_released_claim_stays_released_when_the_clock_goes_back() -> None:
    """A claim that was released after it had lapsed stays free, whatever the clock says."""
    now_s = 100.0
    ledger = MemoryLedger(lambda: now_s)
    ledger.claim("far-000001", "a:1", ttl_s=10.0)
    now_s = 200.0
    ledger.release("far-000001", "a:1")
    now_s = 100.0
    assert ledger.claims() == {}
