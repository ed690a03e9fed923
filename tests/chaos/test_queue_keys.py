import json

import pytest

from farm.spec.job import queue_key
from tests.chaos.poison import poisons
from tests.chaos.queue_keys import is_queue, job_of, redelivered

_MESSAGE = json.dumps(
    {
        "body": "W10=",
        "content-type": "application/json",
        "headers": {"id": "cables:0123456789ab:far-000003", "task": "farm.render_image"},
        "properties": {"delivery_tag": "one"},
    }
)


@pytest.mark.parametrize(
    "key", ["farm", "farm\x06\x163", "farm.cables:0123456789ab", "farm.cables:0123456789ab\x06\x163"]
)
def test_lists_of_messages(key: str) -> None:
    """Queues of all datasets or of one, with and without priorities, are known by their keys."""
    assert is_queue(key)


@pytest.mark.parametrize(
    "key", [f"farm:{queue_key('farm', 'a' * 64)}:finished", "unacked", "farmer", "_kombu.binding.farm"]
)
def test_other_keys(key: str) -> None:
    """A ledger's lists and Celery's other keys aren't queues."""
    assert not is_queue(key)


def test_job_of_a_message() -> None:
    """The job's id is read from the task's."""
    assert job_of(_MESSAGE) == "far-000003"


def test_job_of_garbage() -> None:
    """A text that isn't a message has no job."""
    assert [job_of(garbage) for garbage in ("", "null", "{}", "[1]", "no JSON")] == [None] * 5


def test_redelivery_is_the_same_task() -> None:
    """Only the tag of the delivery changes."""
    again = json.loads(redelivered(_MESSAGE))
    first = json.loads(_MESSAGE)
    assert again["properties"].pop("delivery_tag") != first["properties"].pop("delivery_tag")
    assert again == first


def test_poisons_are_no_copies() -> None:
    """Every kind of poison differs from the others and from the message that it was made from."""
    made = poisons(_MESSAGE)
    assert len({*made, _MESSAGE}) == len(made) + 1
