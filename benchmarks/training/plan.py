"""The plan of a run: the sets of pictures to train and test on."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.pictures.making import STYLES, NamedDataset, make
from benchmarks.training.examples import Examples, examples_of, photographs_in
from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.errors import SpecError

PHOTOGRAPHS = "photographs"
"""Name of the user's own test set."""

_TEST_SEED = 1_000_003
"""Number added to the seed for test pictures, so that they share no draw with the training pictures."""


@dataclass(frozen=True, slots=True)
class Plan:
    """The sets of pictures to train and test on, and the length of the training.

    Attributes:
        seed: seed of the datasets that are made, of the initial weights, the order and the augmentation.
        images: number of images to train on, of each style that is made.
        test_images: number of images to test on, of each style that is made.
        epochs: number of passes over the training pictures.
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
        """Refuse a plan that can't be carried out.

        Raises:
            SpecError: if there are too few pictures or epochs, or two sets have the same name.
        """
        if min(self.images, self.test_images, self.epochs) < 1:
            raise SpecError("give at least 1 of --images, --test-images and --epochs")
        for sets in (self.train, self.test):
            names = [named.name for named in sets]
            if len(set(names)) < len(names) or PHOTOGRAPHS in names:
                raise SpecError(f"give each --train and each --test a name of its own; '{PHOTOGRAPHS}' is taken")


def read_sets(plan: Plan, folder: Path, tell: Callable[[str], None]) -> tuple[dict[str, Examples], dict[str, Examples]]:
    """Read the training and the test sets, by name; datasets that don't exist are made, unfinished ones completed.

    Args:
        plan: the plan.
        folder: folder that keeps the datasets that are made.
        tell: function called with a description of each dataset that is about to be made.

    Raises:
        SpecError: if the folder of photographs is wrong.
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
