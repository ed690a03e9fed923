"""The kinds of drawn scenes that the stress test plays, and how many of each."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import islice
from types import MappingProxyType

from farm.spec.category import Category
from farm.spec.job import Job


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of drawn scenes.

    Attributes:
        name: name in tables and in `--only NAME:JOB`.
        falls: number of scenes, the same of each category; 0 if they are played only where the command line asks.
        style: style of the scenes.
        overrides: what the description has besides, such as `{"ranges": {"placement": {"coil_share": 1.0}}}`.
    """

    name: str
    falls: int
    style: str = "wide"
    overrides: Mapping[str, object] = field(default_factory=lambda: MappingProxyType({}))


TANGLES = ("heap", "knot", "threaded", "crossed_bundles", "peg")
"""The kinds of tangle, as `farm.spec.ranges.tangle.TangleRanges` names their shares."""


def _tangled(name: str) -> Kind:
    """A kind whose scenes all have one kind of tangle, where their category can have it."""
    shares = {f"{each}_share": float(each == name) for each in TANGLES}
    return Kind(name, 204, overrides={"ranges": {"placement": {"tangle": shares}}})


KINDS = (Kind("wide", 1980), *(_tangled(name) for name in TANGLES), Kind("published", 0, style="published"))
"""Every kind of drawn scenes: a row in the tables, and more rows by what the scenes hold."""


@dataclass(frozen=True, slots=True)
class Draw:
    """One drawn scene: the first attempt at a job of a dataset with a seed and a kind's description."""

    kind: str
    seed: int
    job: str

    @property
    def name(self) -> str:
        """The name by which `--only` plays it alone."""
        return f"{self.kind}:{self.job}"


def draws_of(kind: Kind, falls: int, seed: int) -> list[Draw]:
    """List the first jobs of a kind, all categories in turn."""
    jobs = (Job(category=category, index=index) for index in range(falls) for category in Category)
    return [Draw(kind.name, seed, job.id) for job in islice(jobs, falls)]


def draw_named(name: str, seed: int) -> Draw:
    """Find the scene that `--only` names, such as `wide:far-000123`.

    Raises:
        ValueError: if there is no such kind.
        MessageError: if the job's id is none.
    """
    kind, _, job = name.partition(":")
    if kind not in {each.name for each in KINDS}:
        raise ValueError(f"{name!r} names no scene: expected a number, or KIND:JOB as in wide:far-000123")
    return Draw(kind, seed, Job.from_id(job).id)
