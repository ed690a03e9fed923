"""The agreement of predicted masks with true ones: intersection over union, and Dice."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Agreement:
    """Numbers of pixels of a predicted mask and the true one.

    Attributes:
        hits: pixels that are cable in both.
        false_alarms: pixels that are cable in the prediction alone.
        misses: pixels that are cable in the true mask alone.
    """

    hits: int
    false_alarms: int
    misses: int

    @property
    def iou(self) -> float:
        """Intersection over union; 1 if neither mask shows a cable."""
        union = self.hits + self.false_alarms + self.misses
        return self.hits / union if union else 1.0

    @property
    def dice(self) -> float:
        """Twice the intersection over the sum of both areas; 1 if neither mask shows a cable."""
        both = 2 * self.hits + self.false_alarms + self.misses
        return 2 * self.hits / both if both else 1.0


@dataclass(frozen=True, slots=True)
class Scores:
    """The scores of a network on a set of pictures.

    Attributes:
        pictures: number of pictures.
        mean_iou: mean IoU of the pictures.
        iou_error: standard error of that mean; NaN for one picture.
        mean_dice: mean Dice of the pictures.
        pixel_iou: IoU of the pixels of all pictures together.
        pixel_dice: Dice of the pixels of all pictures together.
    """

    pictures: int
    mean_iou: float
    iou_error: float
    mean_dice: float
    pixel_iou: float
    pixel_dice: float


def agreement(predicted: NDArray[np.bool_], true: NDArray[np.bool_]) -> Agreement:
    """Compare two masks of the same shape."""
    return Agreement(
        hits=int(np.count_nonzero(predicted & true)),
        false_alarms=int(np.count_nonzero(predicted & ~true)),
        misses=int(np.count_nonzero(~predicted & true)),
    )


def scores(agreements: Sequence[Agreement]) -> Scores:
    """The scores over the pictures of a set, of which there is at least one."""
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
