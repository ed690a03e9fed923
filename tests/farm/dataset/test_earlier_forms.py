"""Headers of earlier releases, put into today's form."""

import pytest

from farm.dataset.earlier_forms import in_todays_form


def test_settings_of_the_cloth_move_to_the_cloth() -> None:
    """A header from before there were rods asks for cloth, with its settings."""
    written = {"spec": {"seed": 1, "fall": {"max_frames": 9, "quality": 2, "max_attempts": 3}}}
    fall = {"max_attempts": 3, "cloth": {"max_frames": 9, "quality": 2}}
    assert in_todays_form(written) == {"spec": {"seed": 1, "simulator": "cloth", "fall": fall}}


@pytest.mark.parametrize(
    "written",
    [
        {"spec": {"simulator": "rod", "fall": {"max_attempts": 3, "cloth": {"max_frames": 9}}}},
        {"spec": {"fall": {"max_attempts": 3}}},
        {"spec": {"fall": 7}},
        {"spec": []},
        {},
    ],
)
def test_other_values_stay(written: dict[str, object]) -> None:
    """What is in place, and what is no header at all, is not touched."""
    assert in_todays_form(written) == written
