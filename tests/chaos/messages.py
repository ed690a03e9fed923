"""Tamper with waiting messages; each function tells whether there was anything to change."""

import numpy as np

from tests.chaos.farm_under_test import FarmUnderTest
from tests.chaos.poison import poisons
from tests.chaos.queue_keys import job_of, redelivered, waiting

_POISONS_AT_ONCE = 3
_LOST_AT_ONCE = 20


def remember(farm: FarmUnderTest) -> None:
    """Keep a copy of each waiting message, to deliver it again when its job is done.

    Raises:
        redis.RedisError: if Redis can't be reached.
    """
    for key, found in waiting(farm.redis.client).items():
        for message in found:
            job_id = job_of(message)
            if job_id is not None:
                farm.known_messages.setdefault(job_id, (key, message))


def duplicate(farm: FarmUnderTest, rng: np.random.Generator) -> bool:
    """Put a copy of every waiting message into its list, every second one as the very same delivery."""
    lists = waiting(farm.redis.client)
    for key, found in lists.items():
        copies = [redelivered(message) if number % 2 else message for number, message in enumerate(found)]
        farm.redis.client.lpush(key, *[copies[place] for place in rng.permutation(len(copies))])
    return bool(lists)


def redeliver_done(farm: FarmUnderTest, rng: np.random.Generator) -> bool:
    """Deliver the messages of all done jobs again, before the waiting ones."""
    del rng
    done = [farm.known_messages[job_id] for job_id in farm.manifests.seen() if job_id in farm.known_messages]
    for key, message in done:
        farm.redis.client.rpush(key, redelivered(message))
    return bool(done)


def lose(farm: FarmUnderTest, rng: np.random.Generator) -> bool:
    """Remove some of the waiting messages."""
    lost = 0
    for key, found in waiting(farm.redis.client).items():
        for place in rng.permutation(len(found))[:_LOST_AT_ONCE]:
            lost += farm.redis.client.lrem(key, 1, found[place])
    return lost > 0


def poison(farm: FarmUnderTest, rng: np.random.Generator) -> bool:
    """Put messages that no worker understands before the waiting ones, so that they are taken next."""
    if not farm.known_messages:
        return False
    key, message = next(iter(farm.known_messages.values()))
    choice = rng.permutation(poisons(message))[:_POISONS_AT_ONCE]
    farm.redis.client.rpush(key, *[str(each) for each in choice])
    return True
