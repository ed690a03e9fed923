"""What a simulation counts, in arrays so that compiled code can."""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.model import Array

STEPS, SWEEPS, ROUNDS, ITERATIONS, LISTS, CONTACTS, UNKEPT, RETRIES, STOPS = range(9)
"""Places in `Tally.counts`."""

COUNT_NAMES = (
    "steps",
    "sweeps",
    "rounds",
    "length_iterations",
    "lists",
    "contacts",
    "lengths_unkept",
    "retries",
    "stops",
)


class Tally(NamedTuple):
    """What was done.

    Attributes:
        counts: time steps; sweeps over contacts; turns of sweeps and lengths; iterations of the lengths; lists of
            candidates; contacts summed over steps; rods that did not keep their lengths at first; steps tried again
            from no impulses; steps that ended with all rods stopped, as no sound end was found.
        time: (1,) s.
        quiet: (1,) s that the rods have been at rest.
        wary: (1,) steps to be made before a greater time step is tried.
    """

    counts: Integers
    time: Array
    quiet: Array
    wary: Integers


def new_tally() -> Tally:
    """All 0."""
    return Tally(np.zeros(len(COUNT_NAMES), np.int64), np.zeros(1), np.zeros(1), np.zeros(1, np.int64))
