"""The counts of a simulation's work, in arrays that compiled code can change."""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.model import Array

STEPS, SWEEPS, ROUNDS, ITERATIONS, LISTS, CONTACTS, UNKEPT, RETRIES, STOPS, GAINS, MISSES, PASSES = range(12)
"""Numbers of the entries of `Tally.counts`."""

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
    "gains",
    "misses",
    "passes",
)


class Tally(NamedTuple):
    """The counts and times of a simulation.

    Attributes:
        counts: (12,) numbers of time steps; sweeps over contacts; turns of sweeps and lengths; iterations of the
            lengths; lists of candidates; contacts, summed over steps; rods that did not keep their lengths in a step;
            attempts at steps that had no sound end; steps that stopped all rods, as no sound end was found; and
            tried ends of steps that gained energy, left rods too deep within each other, or let them pass through each
            other.
        time: (1,) time since the start, s.
        quiet: (1,) time for which the rods have been at rest, s.
        jolt: (1,) distance by which the change of a node's velocity has bent its way in the last step, m.
        calm: (1,) number of steps in a row for which that was little, and all rods had landed.
        wary: (1,) number of steps before a larger time step is tried.
    """

    counts: Integers
    time: Array
    quiet: Array
    jolt: Array
    calm: Integers
    wary: Integers


def new_tally() -> Tally:
    """Make a tally of zeros."""
    return Tally(
        counts=np.zeros(len(COUNT_NAMES), np.int64),
        time=np.zeros(1),
        quiet=np.zeros(1),
        jolt=np.zeros(1),
        calm=np.zeros(1, np.int64),
        wary=np.zeros(1, np.int64),
    )
