"""What came of training on one set of pictures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.training.examples import Examples
from benchmarks.training.scores import Scores, agreement, scores


@dataclass(frozen=True, slots=True)
class Lesson:
    """One network.

    Attributes:
        name: of the set it was trained on.
        pictures: of that set.
        losses: mean of each epoch.
        seconds: of the training.
        masks: (N, H, W) that it sees in the pictures of each test set.
    """

    name: str
    pictures: int
    losses: Sequence[float]
    seconds: float
    masks: Mapping[str, NDArray[np.bool_]]

    def scores(self, test: str, examples: Examples) -> Scores:
        """What it reaches on a test set, by the set's name and its true masks."""
        pairs = zip(self.masks[test], examples.masks, strict=True)
        return scores([agreement(seen, true) for seen, true in pairs])
