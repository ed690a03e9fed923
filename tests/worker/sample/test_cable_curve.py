"""Natural curves of cables."""

import numpy as np
from scipy.integrate import trapezoid

from farm.spec.styles import RANGES_OF, Style
from worker.sample.cable_curve import sample_course
from worker.simulate.shapes import bent_rod

PLACEMENT = RANGES_OF[Style.WIDE].placement


def turned(bends: tuple[float, ...], length: float) -> float:
    """The total turn of a curve, in turns."""
    return float(abs(trapezoid(bends, dx=length / (len(bends) - 1))) / (2 * np.pi))


def test_a_loop_turns_once_and_lies_on_itself() -> None:
    """A loop crosses itself in plan, and its end starts higher by more than its diameter between the passes."""
    ranges = PLACEMENT.model_copy(update={"loop_share": 1.0, "coil_share": 0.0})
    rng = np.random.default_rng(0)
    for _ in range(30):
        course = sample_course(ranges, (0.0, 0.0), 0.4, 0.003, rng)
        assert 0.9 < turned(course.bends_per_m, 0.4) < 1.5
        curve = bent_rod(0.4, course.bends_per_m, 400)
        gap = np.linalg.norm(curve[:, None] - curve[None], axis=2) + 9 * (
            np.abs(np.subtract.outer(np.arange(400), np.arange(400))) < 20
        )
        first, last = np.unravel_index(gap.argmin(), gap.shape)
        assert gap.min() < 0.002
        assert course.rise_m * abs(int(last) - int(first)) / 399 > 0.003


def test_a_coil_rises_by_more_than_its_thickness_a_turn() -> None:
    """The rise of a coil keeps its turns from starting within each other."""
    ranges = PLACEMENT.model_copy(update={"loop_share": 0.0, "coil_share": 1.0})
    rng = np.random.default_rng(1)
    for _ in range(30):
        course = sample_course(ranges, (0.0, 0.0), 0.5, 0.002, rng)
        turns = turned(course.bends_per_m, 0.5)
        assert course.rise_m == 0.0 or course.rise_m / turns > 1.2 * 0.002


def test_other_cables_keep_their_gentle_bends() -> None:
    """Other cables have their drawn bends and are level."""
    ranges = PLACEMENT.model_copy(update={"loop_share": 0.0, "coil_share": 0.0})
    course = sample_course(ranges, (1.0, -2.0, 3.0), 0.4, 0.002, np.random.default_rng(0))
    assert (course.bends_per_m, course.rise_m) == ((1.0, -2.0, 3.0), 0.0)
