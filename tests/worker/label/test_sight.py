"""Whether a picture shows enough of its cables."""

import numpy as np
import pytest

from tests.worker.scenes import make_scene
from worker.label.sight import find_sight_fault

SCENE = make_scene()


def mask(shown: int) -> np.typing.NDArray[np.uint8]:
    """A mask of 10 by 20 pixels, of which the first ones show a cable."""
    pixels = np.zeros(200, np.uint8)
    pixels[:shown] = 255
    return pixels.reshape(10, 20)


@pytest.mark.parametrize(("shown", "least", "is_enough"), [(2, 0.01, True), (1, 0.01, False), (0, 0.0, True)])
def test_a_share_below_the_least_is_a_fault(shown: int, least: float, is_enough: bool) -> None:
    """The least share itself is enough, and so is nothing where nothing is asked for."""
    assert (find_sight_fault(SCENE, mask(shown), least) is None) == is_enough


def test_the_fault_names_both_shares_and_the_key() -> None:
    """A manifest tells it as the reason against an attempt."""
    fault = find_sight_fault(SCENE, mask(1), 0.02)
    assert fault == "cables are seen in 0.50% of the picture, less than 2.00% (least_visible_share)"


def test_a_scene_without_cables_has_nothing_to_show() -> None:
    """The least share holds for pictures of cables alone."""
    assert find_sight_fault(SCENE.model_copy(update={"cables": ()}), mask(0), 0.02) is None
