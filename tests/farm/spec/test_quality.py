"""Quality as an error budget."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.errors import SpecError
from farm.spec import quality
from farm.spec.category import Background, Category
from farm.spec.parse import parse_spec
from farm.spec.quality import (
    REFERENCE,
    Budget,
    CalibratedSettings,
    Preset,
    budget_of,
    calibration,
    cheapest,
    read_quality,
    settings_for,
)
from farm.spec.rendering import CyclesSettings, PictureSettings

PRESETS = (Preset.DRAFT, Preset.STANDARD)

ROWS = st.lists(
    st.builds(
        CalibratedSettings,
        settings=st.just(PictureSettings(cycles=CyclesSettings(samples=4))),
        seconds=st.floats(0.1, 10),
        flip=st.floats(0, 0.2),
        psnr_db=st.floats(20, 50),
    ),
    max_size=8,
).map(tuple)


@given(rows=ROWS, flip=st.floats(0, 0.2), psnr=st.floats(20, 50))
def test_the_cheapest_within_the_budget_is_chosen(
    rows: tuple[CalibratedSettings, ...], flip: float, psnr: float
) -> None:
    """The choice keeps to the budget, nothing cheaper does, and there is none only if nothing keeps to it."""
    within = [row for row in rows if row.flip <= flip and row.psnr_db >= psnr]
    chosen = cheapest(rows, Budget(flip=flip, psnr_db=psnr))
    assert (chosen is None) == (not within)
    if chosen is not None:
        assert chosen in within
        assert chosen.seconds == min(row.seconds for row in within)


@pytest.mark.parametrize("category", Category)
@pytest.mark.parametrize("preset", PRESETS)
def test_every_preset_keeps_to_its_budget(preset: Preset, category: Category) -> None:
    """In every category, each preset keeps to its budget by the farm's own calibration."""
    chosen = settings_for(preset, category)
    assert chosen.expected_flip is not None
    assert chosen.expected_flip <= budget_of(preset, category).flip


@pytest.mark.parametrize("category", Category)
def test_draft_is_faster_than_standard(category: Category) -> None:
    """Draft is faster than standard, or equally fast if the cheapest settings are good enough."""
    rows = {row.settings: row.seconds for row in calibration().categories[category]}
    assert rows[settings_for(Preset.DRAFT, category).settings] <= rows[settings_for(Preset.STANDARD, category).settings]


@pytest.mark.parametrize("category", Category)
def test_standard_takes_enough_samples_for_smooth_edges(category: Category) -> None:
    """By mean error two samples would do for far pictures, but then cables are smeared."""
    least = 4 if category.traits.background is Background.HDRI else 6
    assert settings_for(Preset.STANDARD, category).settings.cycles.samples >= least


def test_the_reference_leaves_nothing_out() -> None:
    """The reference leaves nothing out and has no expected error, as errors are measured against it."""
    chosen = settings_for(Preset.REFERENCE, Category.FAR)
    assert chosen.settings is REFERENCE
    assert chosen.expected_flip is None


def test_a_number_is_a_budget_in_every_category() -> None:
    """The expected error of the chosen settings is within the number."""
    for category in Category:
        expected = settings_for(0.08, category).expected_flip
        assert expected is not None
        assert expected <= 0.08


def test_a_budget_that_nothing_keeps_names_the_least() -> None:
    """The error names the least error that a user can ask for."""
    with pytest.raises(ValueError, match=r"the least FLIP is 0\.\d+; for less ask for 'reference'"):
        settings_for(1e-9, Category.FAR)


@pytest.fixture
def without_far(monkeypatch: pytest.MonkeyPatch) -> None:
    """A calibration that knows nothing of far pictures."""
    known = {category: rows for category, rows in calibration().categories.items() if category is not Category.FAR}
    partial = calibration().model_copy(update={"categories": known})
    monkeypatch.setattr(quality, "calibration", lambda: partial)


@pytest.mark.usefixtures("without_far")
def test_a_category_without_calibration_is_refused_with_what_to_run() -> None:
    """As a fault of the description, at the key."""
    with pytest.raises(
        SpecError, match=r"spec\.toml: quality standard: no settings .* for far; run `make bench-render`"
    ):
        parse_spec({"quotas": {"far": 1}}, source="spec.toml")


@pytest.mark.usefixtures("without_far")
def test_a_category_without_calibration_is_rendered_as_a_reference() -> None:
    """So that it can be calibrated."""
    spec = parse_spec({"quotas": {"far": 1}, "quality": "reference"}, source="test")
    assert spec.quotas[Category.FAR] == 1


def test_calibrated_settings_are_worth_having() -> None:
    """No settings are both slower and worse than others of their category."""
    for rows in calibration().categories.values():
        for row in rows:
            assert not [
                other
                for other in rows
                if other.seconds < row.seconds and other.flip <= row.flip and other.psnr_db >= row.psnr_db
            ]


@pytest.mark.parametrize(("text", "expected"), [("draft", "draft"), ("0.02", 0.02), ("1e-2", 0.01), ("best", "best")])
def test_a_flag_is_a_name_or_a_number(text: str, expected: str | float) -> None:
    """Whether there is such a preset, the spec says."""
    assert read_quality(text) == expected
