"""The growth of memory with the number of images, from samples of both."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MIB = 2**20


@dataclass(frozen=True, slots=True)
class Sample:
    """One look at a worker.

    Attributes:
        done: number of images that it had finished.
        rss_bytes: resident memory of its renderer.
    """

    done: int
    rss_bytes: int


def growth_mib(samples: Sequence[Sample], after: int = 0) -> float | None:
    """Growth of resident memory per 100 images: the slope of the straight line that fits the samples best.

    Args:
        samples: samples of one worker.
        after: least number of images of the samples that count.

    Returns:
        MiB; None if fewer than two different numbers of images are left.
    """
    left = [sample for sample in samples if sample.done >= after and sample.rss_bytes]
    if len({sample.done for sample in left}) < 2:
        return None
    slope, _ = np.polyfit([sample.done for sample in left], [sample.rss_bytes / MIB for sample in left], 1)
    return 100.0 * float(slope)
