"""Redis servers that refuse: each is told by name, in one line, before anything is written."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest
import redis

from farm.cli.doctor import examine_redis
from farm.errors import BrokerError
from farm.run.queue.broker import as_broker_error, connect, connect_to_write
from farm.run.queue.refusals import explained, meaning
from farm.run.registry.port import Run
from farm.run.registry.redis import RedisRegistry
from tests.farm.run.queue.servers import REFUSING, refusing_redis

TOLD = {
    "replica": "is a replica",
    "cluster": "is a node of a cluster",
    "full": "is full",
    "locked": "refuses the user or the password",
    "narrow": "access list forbids",
}


@pytest.fixture(scope="module")
def servers(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """The addresses of a Redis of each kind."""
    with ExitStack() as stack:
        urls = {name: stack.enter_context(refusing_redis(name, tmp_path_factory.mktemp(name))) for name in REFUSING}
        # All places of keys are at this one, so that it refuses only what spans two of them.
        cluster = redis.Redis.from_url(urls["cluster"])
        cluster.execute_command("CLUSTER", "ADDSLOTS", *range(16384))  # type: ignore[no-untyped-call]  # redis is typed in parts
        yield urls


@pytest.mark.redis
@pytest.mark.parametrize(("name", "words"), TOLD.items())
def test_what_it_is_and_what_to_do(servers: dict[str, str], name: str, words: str) -> None:
    """A Redis that takes no jobs is told by what it is, in one line, at the first look."""
    with pytest.raises(BrokerError, match=words) as refused:
        connect_to_write(servers[name])
    assert "\n" not in str(refused.value)


@pytest.mark.redis
@pytest.mark.parametrize("name", ["replica", "cluster", "full"])
def test_scripts_tell_it_too(servers: dict[str, str], name: str) -> None:
    """A refusal that comes out of a script of the farm's is told alike."""
    run = Run(dataset="cables", spec_sha256="0" * 64)
    with pytest.raises(BrokerError, match=TOLD[name]):
        RedisRegistry(connect(servers[name])).replace(run)


@pytest.mark.redis
def test_doctor_tells_of_a_forgetful_redis(servers: dict[str, str], redis_url: str) -> None:
    """A Redis that drops keys when it is full gets advice, as does one that refuses; another is well."""
    forgetful = examine_redis(servers["forgetful"])
    assert not forgetful.ok
    assert "allkeys-lru" in forgetful.detail
    assert not examine_redis(servers["replica"]).ok
    assert examine_redis(redis_url).ok


@pytest.mark.redis
def test_a_number_that_no_database_has(redis_url: str) -> None:
    """A database beyond those of the server is told by that."""
    with pytest.raises(BrokerError, match="no database of that number"):
        connect(f"{redis_url}?virtual_host=4000")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            "MISCONF Redis is configured to save RDB snapshots, but it's currently unable to persist to disk.",
            "own disk",
        ),
        ("Redis is loading the dataset in memory", "still loads"),
        ("WRONGPASS invalid username-password pair or user is disabled.", "refuses the user"),
        ("DENIED Redis is running in protected mode because protected mode is enabled", "protected mode"),
        ("Error running script (call to f_1): @user_script:1: -OOM command not allowed", "is full"),
        ("NOREPLICAS Not enough good replicas to write.", "replicas are away"),
        ("BUSY Redis is busy running a script.", "busy with a script"),
        ("unknown command `EVALSHA`, with args beginning with:", "version 5 or newer"),
    ],
)
def test_words_of_other_servers(words: str, told: str) -> None:
    """Refusals that are hard to provoke are known by the words that Redis's own sources have for them."""
    assert told in explained(redis.ResponseError(words))


def test_unknown_words_stay() -> None:
    """A refusal that is not known is told in Redis's own words."""
    error = redis.ResponseError("ERR something\nelse.")
    assert meaning(error) is None
    assert explained(error) == "ERR something else"
    with pytest.raises(BrokerError, match="something"), as_broker_error():
        raise error
