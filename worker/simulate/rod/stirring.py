"""Notes which stretches of nodes sweeps have changed, so that contacts between calm ones are left out."""

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.compiled import compiled

STRETCH = 8
"""Number of consecutive nodes in a stretch. Sweeps note for a whole stretch whether its velocities have changed."""


@compiled
def stir(stirred: Integers, low: int, width: int, sweep: int) -> None:
    """Note for stretches of nodes that a sweep has changed the velocities of `width` nodes from node `low` on."""
    for stretch in range(low // STRETCH, (low + width - 1) // STRETCH + 1):
        stirred[stretch] = sweep


@compiled
def is_calm(stirred: Integers, low: int, high: int, sweep: int) -> bool:
    """Whether neither this sweep nor the one before it has changed the stretches of nodes `low` and `high`."""
    return bool(stirred[low // STRETCH] < sweep - 1 and stirred[high // STRETCH] < sweep - 1)


@compiled
def was_stirred(stirred: Integers, first: int, end: int, sweep: int) -> bool:
    """Whether a sweep after `sweep` has changed a stretch of the nodes from `first` to before `end`."""
    return bool(stirred[first // STRETCH : (end - 1) // STRETCH + 1].max() > sweep)
