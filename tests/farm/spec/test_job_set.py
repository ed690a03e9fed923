"""A set of jobs, against Python's own sets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from tests.stand_in import stand_in_header

QUOTAS = {Category.FAR: 7, Category.FAR_ALIGNED: 0, Category.CLOSE_CONCENTRATED: 4}
ALL = {Job(category=category, index=index) for category, quota in QUOTAS.items() for index in range(quota)}
OUTSIDE = [
    Job(category=Category.FAR, index=7),
    Job(category=Category.FAR_ALIGNED, index=0),
    Job(category=Category.CLOSE_ALIGNED_CONCENTRATED, index=0),
]

ids = st.sets(st.sampled_from(sorted(job.id for job in ALL)))


def some(job_ids: set[str]) -> tuple[JobSet, set[str]]:
    """The same jobs in both kinds of set."""
    jobs = JobSet(QUOTAS)
    for job_id in job_ids:
        jobs.add(Job.from_id(job_id))
    return jobs, job_ids


def told(jobs: JobSet) -> set[str]:
    """The ids in a set, after asserting that each occurs once."""
    found = [job.id for job in jobs]
    assert len(set(found)) == len(found) == len(jobs)
    return set(found)


@given(ids, ids)
def test_algebra(one_ids: set[str], other_ids: set[str]) -> None:
    """Union, intersection, difference and complement equal those of sets, and change neither operand."""
    (one, one_set), (other, other_set) = some(one_ids), some(other_ids)
    assert told(one | other) == one_set | other_set
    assert told(one & other) == one_set & other_set
    assert told(one - other) == one_set - other_set
    assert told(one.others()) == {job.id for job in ALL} - one_set
    assert (one == other) == (one_set == other_set)
    assert (told(one), told(other)) == (one_set, other_set)


@given(ids, st.lists(st.tuples(st.booleans(), st.sampled_from([*sorted(ALL, key=lambda job: job.id), *OUTSIDE]))))
def test_adding_and_removing(first: set[str], steps: list[tuple[bool, Job]]) -> None:
    """Members come and go as in a set; jobs outside the quotas never enter."""
    jobs, expected = some(first)
    for add, job in steps:
        if add:
            assert jobs.add(job) == (job in ALL)
            expected = expected | ({job.id} if job in ALL else set())
        else:
            jobs.discard(job)
            expected = expected - {job.id}
    assert told(jobs) == expected
    assert all((job in jobs) == (job.id in expected) for job in [*ALL, *OUTSIDE])


@given(ids)
def test_counts(members: set[str]) -> None:
    """Members are counted by category, and categories without any have 0."""
    jobs, _ = some(members)
    assert jobs.counts() == {
        category: sum(Job.from_id(job_id).category is category for job_id in members) for category in QUOTAS
    }


@pytest.mark.parametrize("quotas", [{"far": 3, "close_concentrated_light": 5, "far_aligned": 1}, {"far": 1}])
def test_order_is_that_of_the_plan(quotas: dict[str, int]) -> None:
    """The jobs of a full set come in the order of the dataset's plan."""
    spec = stand_in_header(**quotas).spec
    assert list(JobSet(spec.quotas).others()) == list(spec.jobs())


def test_members_of_arrays_are_copied() -> None:
    """A set doesn't change with the arrays from which it was made."""
    array = np.array([True, False])
    jobs = JobSet.of({Category.FAR: array})
    array[:] = False
    assert [job.id for job in jobs] == ["far-000000"]


def test_jobs_that_come_out_are_whole() -> None:
    """A job from a set equals any other job with its id."""
    jobs, _ = some({"far-000003"})
    (job,) = jobs
    assert job == Job.from_id("far-000003")
    assert type(job.index) is int


def test_empty_quotas() -> None:
    """An empty set is empty, and so is its complement under empty quotas."""
    assert list(JobSet({})) == list(JobSet({}).others()) == []
