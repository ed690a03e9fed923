"""How memory grows with images, from samples of both."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MIB = 2**20


@dataclass(frozen=True, slots=True)
class Sample:
    """One look at a worker.

    Attributes:
        done: images it had finished.
        rss_bytes: resident memory of its renderer.
    """

    done: int
    rss_bytes: int


def growth_mib(samples: Sequence[Sample], after: int = 0) -> float | None:
    """MiB that resident memory grows by in 100 images: the slope of the straight line nearest to the samples.

    Args:
        samples: of one process.
        after: samples with fewer images are left out.

    Returns:
        None if fewer than two different numbers of images are left.
    """
    left = [sample for sample in samples if sample.done >= after and sample.rss_bytes]
    if len({sample.done for sample in left}) < 2:
        return None
    slope, _ = np.polyfit([sample.done for sample in left], [sample.rss_bytes / MIB for sample in left], 1)
    return 100.0 * float(slope)
