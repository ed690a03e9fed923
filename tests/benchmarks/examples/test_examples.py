"""Examples of every surface, environment and kind of cable."""

import io

import numpy as np
import pytest
from PIL import Image

from benchmarks.examples.groups import CABLE_KINDS, GROUPS
from benchmarks.examples.options import GROUP_NAMES
from benchmarks.examples.sheet import EDGE_PX, draw_sheet, examples_a_row
from farm.scene.cable import Bundle, Skin
from farm.spec.job import Job
from worker.sample.scene import sample_scene


def test_the_options_name_all_groups() -> None:
    """The options name the groups without importing them, and the two lists agree."""
    assert set(GROUP_NAMES) == set(GROUPS)


@pytest.mark.parametrize("group", GROUPS)
def test_every_example_draws_what_it_shows(group: str) -> None:
    """The four scenes of an example hold its surface or HDRI."""
    examples = list(GROUPS[group](0))
    assert len({example.label for example in examples}) == len(examples) > 5
    for example in examples:
        scene = sample_scene(example.header, Job(category=example.category, index=3), 0)
        if group == "surfaces":
            assert scene.floor is not None
            assert scene.floor.texture == example.label
        elif group == "environments":
            assert scene.hdri_world is not None
            assert scene.hdri_world.hdri == example.label


def test_kinds_of_cables_are_what_they_are_called() -> None:
    """Some kinds of cables are drawn as their labels say."""
    looks = {
        example.label: [
            cable.material
            for index in range(4)
            for cable in sample_scene(example.header, Job(category=example.category, index=index), 0).cables
        ]
        for example in GROUPS["cables"](0)
    }
    assert looks.keys() == CABLE_KINDS.keys()
    assert all(isinstance(look, Bundle) for look in looks["bundle"])
    assert all(isinstance(look, Skin) and look.stripe is not None for look in looks["spiral stripe"])
    assert all(isinstance(look, Skin) and look.marking is not None for look in looks["printed"])
    assert not any(isinstance(look, Skin) for look in looks["published surface"])


def test_a_sheet_has_eight_pictures_a_row() -> None:
    """A row holds eight examples of one picture, two of four, or one of more than eight."""
    assert [examples_a_row(each) for each in (1, 3, 4, 8, 9)] == [8, 2, 2, 1, 1]


def test_an_example_s_pictures_stand_side_by_side() -> None:
    """With four pictures each, the third example begins a new row."""
    red = np.full((64, 64, 3), (255, 0, 0), np.uint8)
    sheet = Image.open(io.BytesIO(draw_sheet([(name, 4 * [red]) for name in ("one", "two", "three")])))
    assert sheet.size[0] > 8 * EDGE_PX
    assert 2 * EDGE_PX < sheet.size[1] < 3 * EDGE_PX
    pixel = sheet.getpixel((EDGE_PX // 2, EDGE_PX // 2))
    assert isinstance(pixel, tuple)
    assert pixel[0] > 230
    assert pixel[1] < 30
