"""How well predicted masks agree with true ones: intersection over union, and Dice."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Agreement:
    """Pixels of a predicted mask and the true one.

    Attributes:
        hits: pixels that both call cable.
        false_alarms: those that the prediction alone does.
        misses: those that the truth alone does.
    """

    hits: int
    false_alarms: int
    misses: int

    @property
    def iou(self) -> float:
        """Intersection over union; 1 where neither shows a cable."""
        union = self.hits + self.false_alarms + self.misses
        return self.hits / union if union else 1.0

    @property
    def dice(self) -> float:
        """Twice the intersection over the sum of both; 1 where neither shows a cable."""
        both = 2 * self.hits + self.false_alarms + self.misses
        return 2 * self.hits / both if both else 1.0


@dataclass(frozen=True, slots=True)
class Scores:
    """What a network reaches on a set of pictures.

    Attributes:
        mean_iou: over the pictures.
        iou_error: the standard error of that mean; NaN for one picture.
        mean_dice: over the pictures.
        pixel_iou: over the pixels of all pictures together.
        pixel_dice: likewise.
    """

    pictures: int
    mean_iou: float
    iou_error: float
    mean_dice: float
    pixel_iou: float
    pixel_dice: float


def agreement(predicted: NDArray[np.bool_], true: NDArray[np.bool_]) -> Agreement:
    """Compare two masks of one shape."""
    return Agreement(
        hits=int(np.count_nonzero(predicted & true)),
        false_alarms=int(np.count_nonzero(predicted & ~true)),
        misses=int(np.count_nonzero(~predicted & true)),
    )


def scores(agreements: Sequence[Agreement]) -> Scores:
    """What the pictures of a set, at least one, come to."""
    ious = [each.iou for each in agreements]
    together = Agreement(
        sum(each.hits for each in agreements),
        sum(each.false_alarms for each in agreements),
        sum(each.misses for each in agreements),
    )
    few = len(ious) < 2
    return Scores(
        pictures=len(ious),
        mean_iou=float(np.mean(ious)),
        iou_error=float("nan") if few else float(np.std(ious, ddof=1) / np.sqrt(len(ious))),
        mean_dice=float(np.mean([each.dice for each in agreements])),
        pixel_iou=together.iou,
        pixel_dice=together.dice,
    )
