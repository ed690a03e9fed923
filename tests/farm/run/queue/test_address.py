"""The form of a Redis's address."""

import pytest

from farm.errors import BrokerError
from farm.run.queue.address import checked
from farm.run.queue.broker import broker_url

REFUSED = (
    ("redis://localhost:6379/0?family=0", "options that no address"),
    ("redis://localhost:6379/0?socket_timeout=x", "options that no address"),
    ("redis://localhost:6379/0?db=3", "options that no address"),
    ("redis://localhost:6379/cables", "'cables' is no database"),
    ("redis://localhost:6379/-1", "'-1' is no database"),
    ("redis://localhost:6379/%zz", "is no database"),
    ("redis://localhost:6379/1/2", "not a readable address"),
    ("rediss://localhost:6379/cables", "'cables' is no database"),
    ("redis://localhost:99999/0", "no port 99999"),
    ("redis://localhost:0/0", "no port 0"),
    ("redis://localhost:-1/0", "not a readable address"),
    ("redis://localhost:abc/0", "not a readable address"),
    ("redis://[::1/0", "not a readable address"),
    ("redis://a:1,b:2/0", "not a readable address"),
    ("redis://a:1/0;redis://b:2/0", "not a readable address"),
    ("redis://%6cocalhost/0", "not a readable address"),
    ("redis://local host/0", "white space"),
    ("redis://localhost/0\nredis://other/0", "white space"),
    ("redis://localhost/0#x", "write %23"),
    ("redis://me:p/w@localhost/0", "percent-encode"),
    ("redis://me:p?w@localhost/0", "%3F for a ?"),
    ("redis+socket://", "needs its whole path"),
    ("redis+socket://tmp/redis.sock", "needs its whole path"),
    ("redis+socket:///tmp/redis.sock?virtual_host=abc", "'abc' is no database"),
    ("redis+socket:///tmp/redis.sock?db=1", "options that no address"),
    ("sentinel://localhost:26379", "name the primary itself"),
    ("redis-cluster://localhost", "no cluster"),
    ("unix:///tmp/redis.sock", "redis+socket:///PATH"),
    ("amqp://localhost", "queue is a Redis"),
    ("REDIS://localhost", "no Redis address"),
    ("localhost:6379", "no Redis address"),
    ("redis:localhost", "no Redis address"),
)

TAKEN = (
    "redis://localhost:6379/0",
    "redis://localhost",
    "redis://localhost/",
    "redis://127.0.0.1:1/15",
    "redis://[::1]:6379/0",
    "redis://[fe80::1%25eth0]:6379/0",
    "redis://:p%2Fw@localhost:6379/0",
    "redis://me:a@b@localhost/0",
    "redis+socket:///tmp/redis.sock",
    "redis+socket:///tmp/redis.sock?virtual_host=3",
)


@pytest.mark.parametrize(("url", "words"), REFUSED)
def test_refused_in_one_line(url: str, words: str) -> None:
    """An address that Celery or redis-py would not read, or would read otherwise, is refused in one line."""
    with pytest.raises(BrokerError) as refused:
        checked(url)
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)
    assert "p/w" not in str(refused.value)


@pytest.mark.parametrize("url", TAKEN)
def test_taken_as_it_is(url: str) -> None:
    """An address in the farm's form stays as it is, but for white space around it."""
    assert checked(f" {url}\n") == url


def test_an_empty_option_is_not_the_default() -> None:
    """An empty --broker, as an unset variable of a shell gives, doesn't choose the Redis of localhost."""
    with pytest.raises(BrokerError, match="--broker is empty"):
        broker_url("")
