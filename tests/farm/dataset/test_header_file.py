"""Writing and reading dataset.json, and the identity that is taken from it."""

import hashlib
import json

import pydantic_core
import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm import __version__
from farm.dataset.header_file import header_content, parse_header, read_header
from farm.dataset.paths import HEADER_FILE
from farm.errors import ConflictError
from farm.spec.header import DatasetHeader
from farm.storage import open_storage
from tests.stand_in import stand_in_header


def test_a_header_comes_back(header: DatasetHeader) -> None:
    """What is written is read again."""
    assert parse_header(header_content(header)).header == header


def test_the_identity_is_that_of_earlier_releases(header: DatasetHeader) -> None:
    """It equals the checksum of the parsed header, which manifests of release 0.1.0 hold."""
    content = header.model_dump(mode="json", exclude={"farm_version"})
    assert parse_header(header_content(header)).identity == hashlib.sha256(pydantic_core.to_json(content)).hexdigest()


def test_a_key_that_a_release_adds_leaves_the_identity(header: DatasetHeader) -> None:
    """A file that lacks a key with a default has the identity of what it holds, and the default's meaning."""
    written = json.loads(header_content(header))
    del written["plates"]
    found = parse_header(json.dumps(written).encode())
    assert found.header == header
    assert found.identity == hashlib.sha256(pydantic_core.to_json(_without_version(written))).hexdigest()
    assert found.identity != parse_header(header_content(header)).identity


def _without_version(written: dict[str, object]) -> dict[str, object]:
    return {key: value for key, value in written.items() if key != "farm_version"}


def test_the_release_is_no_part_of_the_identity(header: DatasetHeader) -> None:
    """The same description from another release has the same identity."""
    other = header.model_copy(update={"farm_version": "9.9"})
    assert parse_header(header_content(other)).identity == parse_header(header_content(header)).identity


@pytest.mark.parametrize("indent", [None, 4, "\t"])
def test_white_space_is_no_part_of_the_identity(header: DatasetHeader, indent: int | str | None) -> None:
    """An editor or a checkout may lay the file out otherwise, also with other line ends."""
    content = json.dumps(json.loads(header_content(header)), indent=indent).replace("\n", "\r\n")
    assert parse_header(content.encode()).identity == parse_header(header_content(header)).identity


@given(seed=st.integers(0, 2**64 - 1), other=st.integers(0, 2**64 - 1))
def test_every_seed_is_another_dataset(seed: int, other: int) -> None:
    """Descriptions that differ have different identities, up to the largest seed."""
    one, two = (parse_header(header_content(stand_in_header(seed=value))).identity for value in (seed, other))
    assert (one == two) == (seed == other)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"farm_version": "7.0.0", "lidar": True}, "written by cable-farm '7.0.0'.*lidar"),
        ({"farm_version": 7}, "written by an unknown release"),
        ({"format": 2}, f"written by cable-farm '{__version__}', not readable by cable-farm {__version__}: format"),
        ({"farm_version": "7\n8", "lidar": True}, r"written by cable-farm '7\\n8'"),
    ],
)
def test_an_unreadable_header_names_its_release(
    tmp_path: object, header: DatasetHeader, change: dict[str, object], said: str
) -> None:
    """A header of a later release is refused with that release's number, in one line."""
    storage = open_storage(str(tmp_path))
    storage.write(HEADER_FILE, json.dumps({**json.loads(header_content(header)), **change}).encode())
    with pytest.raises(ConflictError, match=said) as caught:
        read_header(storage)
    assert "\n" not in str(caught.value)
