"""Makers of labels: found by name, and each called once."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from farm.dataset.formats import PNG
from farm.dataset.outputs import IMAGE, INSTANCES, MASK, OUTPUTS, Output
from farm.scene.picture_size import PictureSize
from farm.spec.rendering import CableDetail
from tests.worker.scenes import make_scene
from worker.geometry import SettledGeometry
from worker.label.label import label_scene
from worker.label.makers import find_maker, make_labels
from worker.simulate.shapes import CableShapes

CALLS: list[SettledGeometry] = []


def make_pair(geometry: SettledGeometry) -> Mapping[str, Any]:
    """Makes two labels at once."""
    CALLS.append(geometry)
    return {"right": 2, "left": 1}


def straight_inputs() -> SettledGeometry:
    """A far scene whose cables lie straight, side by side."""
    scene = make_scene()
    along = np.linspace(-0.2, 0.2, 51)
    count = len(scene.cables)
    shapes = CableShapes(
        nodes_m=tuple(np.stack([along, np.full(51, 0.01 * row), np.full(51, 0.004)], axis=1) for row in range(count)),
        radii_m=np.array([cable.diameter_m / 2 for cable in scene.cables]),
        lengths_m=np.full(count, 0.4),
        speeds_m_s=tuple(np.zeros(51) for _ in range(count)),
        start_order=tuple(range(count)),
        fall_s=0.0,
        steps=0,
    )
    return SettledGeometry(scene, shapes, CableDetail(), PictureSize.square(64))


@pytest.mark.parametrize("name", sorted({output.maker for output in OUTPUTS if output.maker is not None}))
def test_every_maker_is_there(name: str) -> None:
    """Each name in the table leads to a function."""
    assert callable(find_maker(name))


def test_the_renderer_makes_the_image_alone() -> None:
    """Every other output has a maker."""
    assert [output for output in OUTPUTS if output.maker is None] == [IMAGE]


def test_labels_of_the_table() -> None:
    """The makers of mask and instances give what labelling the scene gives; the image is left to the renderer."""
    geometry = straight_inputs()
    expected = label_scene(geometry)
    made = make_labels(geometry, (IMAGE, MASK, INSTANCES))
    assert list(made) == ["mask", "instances"]
    assert np.array_equal(made["mask"], expected.mask)
    assert np.array_equal(made["instances"], expected.instances)
    assert made["mask"].any()


def test_a_maker_of_two_labels_is_called_once() -> None:
    """Labels that share a computation share a call, and come in the table's order."""
    left, right = (
        Output(role, role, PNG, lambda *_: None, maker="tests.worker.label.test_makers:make_pair")
        for role in ("left", "right")
    )
    geometry = straight_inputs()
    CALLS.clear()
    assert list(make_labels(geometry, (left, IMAGE, right)).items()) == [("left", 1), ("right", 2)]
    assert [geometry] == CALLS
    assert make_labels(geometry, (right,)) == {"right": 2}
