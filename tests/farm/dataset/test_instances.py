"""The list of a picture's instances."""

import numpy as np
import pytest

from farm.dataset.instances import VisibleInstance, find_empty_fault, list_instances, number_instances
from farm.scene.cable import Bundle
from farm.scene.scene import Scene
from tests.worker.scenes import make_header, make_scene, make_skin

BUNDLE = Bundle(strands=(make_skin(),) * 3, strand_diameter_m=0.001, lay_m=0.08, phase_deg=0.0, ties=())


def scene_with_a_bundle() -> Scene:
    """A scene of a cable, a bundle of three strands and a cable."""
    scene = make_scene(ranges={"cable": {"count": [3, 3]}})
    first, second, third = scene.cables
    return scene.model_copy(update={"cables": (first, second.model_copy(update={"material": BUNDLE}), third)})


def test_numbers_go_cable_by_cable_and_strand_by_strand() -> None:
    """A cable after a bundle of three has the number of its place and two more."""
    numbered = list(number_instances(scene_with_a_bundle()))
    assert numbered == [(0, None), (1, 0), (1, 1), (1, 2), (2, None)]


def test_what_is_seen_is_listed_with_its_pixels() -> None:
    """An instance of which no pixel is seen is not listed."""
    instances = np.array([[0, 1, 1], [4, 4, 4], [5, 0, 0]], np.uint16)
    assert list_instances(scene_with_a_bundle(), instances) == (
        VisibleInstance(id=1, cable=0, strand=None, pixels=2),
        VisibleInstance(id=4, cable=1, strand=2, pixels=3),
        VisibleInstance(id=5, cable=2, strand=None, pixels=1),
    )


def test_a_number_of_nothing_in_the_scene_is_refused() -> None:
    """The message names the number, and how many instances there are."""
    with pytest.raises(ValueError, match="number 6, but the scene has 5 instances"):
        list_instances(scene_with_a_bundle(), np.full((2, 2), 6, np.uint16))


@pytest.mark.parametrize(
    ("style", "has_cables", "is_seen", "is_fault"),
    [
        ("wide", True, False, True),
        ("wide", True, True, False),
        ("wide", False, False, False),
        ("published", True, False, False),
    ],
)
def test_only_a_picture_that_may_show_no_cable_may_be_empty(
    style: str, has_cables: bool, is_seen: bool, is_fault: bool
) -> None:
    """Its scene has none, or its description allows a visible share of 0."""
    scene = make_scene() if has_cables else make_scene().model_copy(update={"cables": ()})
    spec = make_header(style=style).spec
    assert (find_empty_fault(scene, np.full((2, 2), int(is_seen), np.uint16), spec) is not None) == is_fault


def test_a_scene_without_cables_shows_no_instance() -> None:
    """Its map is empty, and any number in the map is refused."""
    scene = make_scene().model_copy(update={"cables": ()})
    assert list_instances(scene, np.zeros((2, 2), np.uint16)) == ()
    with pytest.raises(ValueError, match="number 1, but the scene has 0 instances"):
        list_instances(scene, np.ones((2, 2), np.uint16))
