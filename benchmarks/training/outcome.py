"""The result of training on one set of pictures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.training.examples import Examples
from benchmarks.training.scores import Scores, agreement, scores


@dataclass(frozen=True, slots=True)
class Lesson:
    """One trained network.

    Attributes:
        name: name of the set that it was trained on.
        pictures: number of pictures of that set.
        losses: mean loss of each epoch.
        seconds: time of the training.
        masks: predicted masks, (N, H, W), for the pictures of each test set, by the set's name.
    """

    name: str
    pictures: int
    losses: Sequence[float]
    seconds: float
    masks: Mapping[str, NDArray[np.bool_]]

    def scores(self, test: str, examples: Examples) -> Scores:
        """The scores on a test set, given the set's name and its examples with the true masks."""
        pairs = zip(self.masks[test], examples.masks, strict=True)
        return scores([agreement(seen, true) for seen, true in pairs])
