"""Descriptions, quotas and plans."""

import itertools
from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.errors import SpecError
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.parse import parse_spec
from farm.spec.quotas import PUBLISHED_WEIGHTS, split_total

TOTALS = st.integers(0, 10**7)
WEIGHTS = st.dictionaries(st.sampled_from(Category), st.integers(0, 1000)).filter(lambda found: sum(found.values()) > 0)
QUOTAS = st.fixed_dictionaries({str(category): st.integers(0, 30) for category in Category}).filter(
    lambda quotas: sum(quotas.values()) > 0
)


def test_published_quotas() -> None:
    """25,000 images are split as published, and categories that the publication has not get none."""
    shares = split_total(25_000)
    assert list(shares.values())[:6] == [5000, 5000, 2500, 2500, 5000, 5000]
    assert not any(list(shares.values())[6:])


@given(TOTALS, WEIGHTS)
def test_split_adds_up(total: int, weights: dict[Category, int]) -> None:
    """Every image goes to one category, and none to a category without weight."""
    quotas = split_total(total, weights)
    assert sum(quotas.values()) == total
    assert all(not quotas[category] for category in Category if not weights.get(category))


@given(TOTALS, WEIGHTS)
def test_split_is_within_one(total: int, weights: dict[Category, int]) -> None:
    """No quota is off its exact share by a whole image (the quota rule, which largest remainders keep)."""
    quotas, sum_of_weights = split_total(total, weights), sum(weights.values())
    for category in Category:
        assert abs(quotas[category] * sum_of_weights - total * weights.get(category, 0)) < sum_of_weights


@given(st.integers(max_value=-1))
def test_negative_total(total: int) -> None:
    """A negative total is refused."""
    with pytest.raises(ValueError, match="negative"):
        split_total(total, PUBLISHED_WEIGHTS)


@given(QUOTAS)
def test_plan_has_the_quotas(quotas: dict[str, int]) -> None:
    """A plan has each job of each category once, numbered from 0."""
    spec = parse_spec({"quotas": quotas}, source="test")
    jobs = list(spec.jobs())
    assert len({job.id for job in jobs}) == len(jobs) == spec.total
    counts = Counter(str(job.category) for job in jobs)
    assert all(counts[category] == quota for category, quota in quotas.items())
    assert all(job.index < quotas[job.category] for job in jobs)


def test_plan_is_lazy() -> None:
    """The first jobs of ten million are made without the others."""
    spec = parse_spec({"quotas": {"far": 10**7}}, source="test")
    assert [job.index for job in itertools.islice(spec.jobs(), 3)] == [0, 1, 2]


@given(QUOTAS, st.integers(0, 2**64 - 1), st.integers(32, 8192))
def test_description_survives_the_disk(quotas: dict[str, int], seed: int, resolution: int) -> None:
    """A description written as JSON is read back the same."""
    spec = parse_spec({"quotas": quotas, "seed": seed, "resolution": resolution}, source="test")
    assert DatasetSpec.model_validate_json(spec.model_dump_json()) == spec


@given(st.dictionaries(st.text(), st.integers() | st.text() | st.floats() | st.lists(st.integers())))
def test_any_mapping_is_read_or_refused(data: dict[str, object]) -> None:
    """Whatever a file holds, the result is a description or one line that names the file."""
    refusal = ""
    try:
        parse_spec(data, source="cables.toml")
    except SpecError as error:
        refusal = str(error)
    assert refusal.startswith("cables.toml: ") or not refusal
    assert len(refusal.splitlines()) <= 1


@pytest.mark.parametrize("seed", [-1, 2**64, 1.0, True, "1"])
def test_seeds(seed: object) -> None:
    """A seed is a whole number that fits in 64 bits."""
    with pytest.raises(SpecError, match="seed"):
        parse_spec({"images": 1, "seed": seed}, source="test")


@pytest.mark.parametrize("resolution", ["640x", "0x480", 31, 8193, -640, 10**20, "5120x32", 640.0, [640, 480, 3]])
def test_sizes_that_no_dataset_has(resolution: object) -> None:
    """The error names the key in one line."""
    with pytest.raises(SpecError, match=r"^spec\.toml: resolution: expected [^\n]*$"):
        parse_spec({"images": 1, "resolution": resolution}, source="spec.toml")


@pytest.mark.parametrize(("resolution", "same"), [("512x512", 512), ([96, 96], 96), ([640, 480], "640x480")])
def test_a_size_is_the_same_however_it_is_given(resolution: object, same: object) -> None:
    """A dataset is what it was whichever way its size is written; a square's header has a number."""
    given, other = (
        parse_spec({"images": 1, "resolution": size}, source="test").model_dump(mode="json")
        for size in (resolution, same)
    )
    assert given == other
    assert given["resolution"] == same
