"""What a run of the measurement trains and tests on."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.pictures.making import STYLES, NamedDataset, make
from benchmarks.training.examples import Examples, examples_of, photographs_in
from farm.dataset.dataset import open_dataset, parse_destination
from farm.errors import SpecError

PHOTOGRAPHS = "photographs"
"""The name of the user's own test set."""

_TEST_SEED = 1_000_003
"""Added to the seed: test pictures share no draw with those to train on."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What to do.

    Attributes:
        seed: of the datasets that are made, the initial weights, the order and the augmentation.
        images: to train on, of each style that is made.
        test_images: to test on, likewise.
        epochs: passes over the training pictures.
        train: datasets to train on, instead of making some.
        test: datasets to test on, instead of making some.
        photographs: a folder of photographs to test on, too.
    """

    seed: int
    images: int
    test_images: int
    epochs: int
    train: tuple[NamedDataset, ...] = ()
    test: tuple[NamedDataset, ...] = ()
    photographs: Path | None = None

    def check(self) -> None:
        """Refuse what can't be done.

        Raises:
            SpecError: for too few pictures or epochs, or two sets of one name.
        """
        if min(self.images, self.test_images, self.epochs) < 1:
            raise SpecError("give at least 1 of --images, --test-images and --epochs")
        for sets in (self.train, self.test):
            names = [named.name for named in sets]
            if len(set(names)) < len(names) or PHOTOGRAPHS in names:
                raise SpecError(f"give each --train and each --test a name of its own; '{PHOTOGRAPHS}' is taken")


def read_sets(plan: Plan, folder: Path, tell: Callable[[str], None]) -> tuple[dict[str, Examples], dict[str, Examples]]:
    """The sets to train on and those to test on, by name; made, or completed, where they are not there.

    Args:
        plan: what to do.
        folder: where datasets that are made are kept.
        tell: called with what is begun.

    Raises:
        SpecError: if the photographs are not as they must be.
        FarmError: if a dataset can't be made or read.
    """
    photographs = {PHOTOGRAPHS: photographs_in(plan.photographs)} if plan.photographs else {}
    train = dict(_sets(plan.train, plan.images, plan.seed, folder, tell))
    test = dict(_sets(plan.test, plan.test_images, plan.seed + _TEST_SEED, folder, tell))
    return train, {**test, **photographs}


def _sets(
    there: Sequence[NamedDataset], images: int, seed: int, folder: Path, tell: Callable[[str], None]
) -> Iterator[tuple[str, Examples]]:
    for named in there:
        yield named.name, examples_of(open_dataset(parse_destination(named.place)))
    if not there:
        for style in STYLES:
            tell(f"{style}: {images} images, seed {seed}")
            yield style, examples_of(make(style, images, seed, folder))
