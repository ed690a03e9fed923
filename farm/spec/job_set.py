"""A set of a dataset's jobs that takes one byte for each job, so that a million jobs take a megabyte."""

from collections.abc import Iterator, Mapping
from typing import Self

import numpy as np
from numpy.typing import NDArray

from farm.spec.category import Category
from farm.spec.job import Job


class JobSet:
    """Some of the jobs that quotas ask for.

    Args:
        quotas: number of images asked for, by category; the set starts empty.
    """

    def __init__(self, quotas: Mapping[Category, int]) -> None:
        self._members = {category: np.zeros(quota, np.bool_) for category, quota in quotas.items()}

    @classmethod
    def of(cls, members: Mapping[Category, NDArray[np.bool_]]) -> Self:
        """Make a set from its members.

        Args:
            members: for each category, (quota,) bool, true at the indices of the set's jobs; the arrays are copied.
        """
        found = cls({})
        found._members = {category: array.copy() for category, array in members.items()}
        return found

    def add(self, job: Job) -> bool:
        """Add a job; return False if the quotas do not ask for it."""
        members = self._members.get(job.category)
        if members is None or job.index >= len(members):
            return False
        members[job.index] = True
        return True

    def discard(self, job: Job) -> None:
        """Remove a job if the set has it."""
        if job in self:
            self._members[job.category][job.index] = False

    def __contains__(self, job: Job) -> bool:
        members = self._members.get(job.category)
        return members is not None and job.index < len(members) and bool(members[job.index])

    def __len__(self) -> int:
        return sum(self.counts().values())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, JobSet) and all(
            np.array_equal(mine, other._members[category]) for category, mine in self._members.items()
        )

    __hash__ = None  # type: ignore[assignment]  # a set can change

    def counts(self) -> dict[Category, int]:
        """Count the members of each category."""
        return {category: int(np.count_nonzero(members)) for category, members in self._members.items()}

    def __or__(self, other: Self) -> Self:
        return self.of({category: mine | other._members[category] for category, mine in self._members.items()})

    def __and__(self, other: Self) -> Self:
        return self.of({category: mine & other._members[category] for category, mine in self._members.items()})

    def __sub__(self, other: Self) -> Self:
        return self.of({category: mine & ~other._members[category] for category, mine in self._members.items()})

    def others(self) -> Self:
        """Return the jobs that the quotas ask for and that this set does not have."""
        return self.of({category: ~mine for category, mine in self._members.items()})

    def by_category(self) -> Iterator[Job]:
        """Yield the jobs by category, in the categories' own order, and then by index."""
        for category in Category:
            for index in np.flatnonzero(self._members.get(category, ())).tolist():
                yield Job.model_construct(category=category, index=index)

    def members(self) -> dict[Category, NDArray[np.bool_]]:
        """Return, for each category, (quota,) bool, true at the indices of the set's jobs; the arrays are copies."""
        return {category: members.copy() for category, members in self._members.items()}

    def __iter__(self) -> Iterator[Job]:
        """Yield the jobs in the order of `DatasetSpec.jobs`: by index, and for each index by category."""
        categories = list(self._members)
        indices = [np.flatnonzero(self._members[category]) for category in categories]
        number = np.repeat(np.arange(len(categories)), [len(found) for found in indices])
        index = np.concatenate([np.zeros(0, np.intp), *indices])
        for place in np.lexsort((number, index)):
            yield Job.model_construct(category=categories[number[place]], index=int(index[place]))
