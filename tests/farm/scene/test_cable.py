"""Cables that can't be laid are refused where a scene is read."""

import pytest
from pydantic import ValidationError

from farm.scene.cable import Cable
from tests.worker.scenes import make_scene


def changed(**fields: object) -> Cable:
    """A cable of a scene with other fields, validated."""
    return Cable.model_validate({**make_scene().cables[0].model_dump(), **fields})


def test_heights_are_two_or_more_or_none() -> None:
    """One height says nothing of the way between the ends."""
    assert changed(heights_m=(0.0, 0.001)).heights_m == (0.0, 0.001)
    assert changed(heights_m=()).heights_m == ()
    with pytest.raises(ValidationError, match="heights_m must have two heights or more, or none"):
        changed(heights_m=(0.001,))


def test_a_cable_rises_by_less_than_its_length() -> None:
    """A cable that rises by its length would stand upright."""
    with pytest.raises(ValidationError, match="rise_m must be below the length"):
        changed(rise_m=10.0)
