"""Job ids and messages: what they accept, and that they refuse everything else."""

import base64
import json
import re
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import file_path, manifest_path
from farm.errors import MessageError
from farm.spec.category import Category
from farm.spec.job import MAX_INDEX, Job, JobMessage, queue_key

JOBS = st.builds(Job, category=st.sampled_from(Category), index=st.integers(0, MAX_INDEX))
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=5),
)
GOLDEN = Path(__file__).parents[1] / "run" / "golden" / "0.1.0" / "envelope.json"
GOOD = {"version": 1, "dataset": "cables", "spec_sha256": "0" * 64, "job_id": "far-000001"}


def assert_decoded_or_refused(payload: object) -> None:
    """Assert that the payload decodes to what it says, or is refused in one line."""
    refusal = ""
    try:
        assert JobMessage.decode(payload).encode() == payload
    except MessageError as error:
        refusal = str(error)
    assert len(refusal.splitlines()) <= 1


@given(JOBS)
def test_id_is_read_back(job: Job) -> None:
    """The id of every job gives the job back."""
    assert Job.from_id(job.id) == job


@given(JOBS, JOBS)
def test_ids_are_unique(one: Job, other: Job) -> None:
    """Different jobs have different ids, and so different files."""
    assert (one.id == other.id) == (one == other)
    assert (manifest_path(one) == manifest_path(other)) == (one == other)


@given(st.text())
def test_no_other_text_is_an_id(text: str) -> None:
    """A text that is read as an id is exactly that job's id."""
    with suppress(MessageError):
        assert Job.from_id(text).id == text


@pytest.mark.parametrize(
    "text",
    [
        "",
        "far",
        "far-1",
        "far-0000001",
        "far-000001\n",
        " far-000001",
        "near-000001",
        "FAR-000001",
        "far-00000\uff11",
        "../far-000001",
        "far-000001/..",
        "far--00001",
        "far-0000000000001",
    ],
)
def test_malformed_ids(text: str) -> None:
    """Ids with paths, other digits, padding or unknown categories are refused."""
    with pytest.raises(MessageError):
        Job.from_id(text)


@given(JOBS)
def test_files_stay_in_the_category(job: Job) -> None:
    """Every path of a job is three plain parts, the category first."""
    for path in [manifest_path(job), *(file_path(job, output) for output in OUTPUTS)]:
        parts = path.split("/")
        assert len(parts) == 3
        assert parts[0] == job.category
        assert ".." not in parts


@given(JOBS)
def test_message_survives_the_wire(job: Job) -> None:
    """What was encoded as JSON decodes to the same message and job."""
    message = JobMessage(dataset="cables", spec_sha256="0" * 64, job_id=job.id)
    decoded = JobMessage.decode(json.loads(json.dumps(message.encode())))
    assert decoded == message
    assert decoded.job == job


@given(JSON)
def test_any_json_is_decoded_or_refused(payload: object) -> None:
    """Whatever the payload, the result is a message or one line."""
    assert_decoded_or_refused(payload)


@given(st.sampled_from(sorted(GOOD)), JSON)
def test_any_value_in_a_good_message(key: str, value: object) -> None:
    """A message with one value replaced is decoded unchanged or refused in one line."""
    payload = GOOD | {key: value}
    assert_decoded_or_refused(payload)


@given(st.text(min_size=1).filter(lambda key: key not in GOOD), JSON)
def test_unknown_keys_are_refused(key: str, value: object) -> None:
    """A message with one more key is refused."""
    with pytest.raises(MessageError):
        JobMessage.decode(GOOD | {key: value})


@pytest.mark.parametrize(
    "name",
    ["", ".", "..", "a/b", "/a", "a\\b", ".a", "-a", "a\n", "a" * 101, "a\0", "a\u202eb", " a", "a ", "\u2028a"],
)
def test_dataset_names_hold_no_path(name: str) -> None:
    """A dataset's name can't climb, hide or end in a line break."""
    with pytest.raises(MessageError):
        JobMessage.decode(GOOD | {"dataset": name})


@pytest.mark.parametrize(
    "name", ["cables (1)", "cables - Copy", "Kopie von Kabel", "ケーブル", "a" * 100, "é" * 100, "50%"]
)
def test_copies_have_names_of_their_own(name: str) -> None:
    """Whatever a file manager calls a copy, its task ids are short and plain ASCII without blanks."""
    message = JobMessage.decode(GOOD | {"dataset": name})
    assert re.fullmatch(r"[!-~]{1,180}", message.task_id)


def test_names_that_begin_alike_have_keys_of_their_own() -> None:
    """Two long names that differ at their end don't share a queue."""
    assert queue_key("é" * 99 + "a", "0" * 64) != queue_key("é" * 99 + "b", "0" * 64)


def test_message_of_the_first_release() -> None:
    """A message as release 0.1.0 sent it is read, and without a place it is written in the same way."""
    _, keywords, _ = json.loads(base64.b64decode(json.loads(GOLDEN.read_text())["body"]))
    message = JobMessage.decode(keywords["message"])
    assert message.place == ""
    assert message.encode() == keywords["message"]
    assert message.task_id == json.loads(GOLDEN.read_text())["headers"]["id"]


def test_place_is_part_of_the_task_id() -> None:
    """Equal datasets in two places have tasks of different ids, which release 0.1.0 would refuse as messages."""
    message = JobMessage.decode(GOOD | {"place": "0123456789abcdef"})
    assert message.task_id == "cables:000000000000:0123456789abcdef:far-000001"
    assert message.encode().keys() - GOOD.keys() == {"place"}


@pytest.mark.parametrize("place", ["0", "0123456789abcdeF", "../3456789abcdef", "0123456789abcdef\n", 7, None])
def test_bad_places(place: object) -> None:
    """A place that isn't an id is refused: it is part of the names of keys and folders."""
    with pytest.raises(MessageError, match="place"):
        JobMessage.decode(GOOD | {"place": place})
