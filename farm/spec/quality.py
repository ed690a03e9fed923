"""Quality as an error budget, and the choice of the fastest settings that keep a category's pictures within it.

An error is NVIDIA's FLIP (Andersson et al. 2020, "FLIP: A difference evaluator for alternating images"), the mean over
a picture of how much a viewer would see it differ from one without noise when flipping between the two: 0 is none, 1
black against white. `make bench-render` measures it, and its calibration comes with the farm.
"""

from collections.abc import Mapping
from enum import StrEnum
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from pydantic import BeforeValidator, Field

from farm.model import Model
from farm.spec.category import Background, Category, Light
from farm.spec.rendering import CableDetail, CyclesSettings, Denoiser, Economy, PictureSettings

CALIBRATION = Path(__file__).with_name("calibration.json")


class Preset(StrEnum):
    """The named qualities: each trades the time that a picture takes against its noise."""

    DRAFT = "draft"
    STANDARD = "standard"
    REFERENCE = "reference"


MOST_FLIP = 0.5
"""The greatest mean FLIP that can be asked for: beyond it a picture is hardly one of its scene."""


def _check_quality(value: object) -> str | float:
    if isinstance(value, str) and value in set(Preset):
        return value
    if isinstance(value, int | float) and not isinstance(value, bool) and 0 < value <= MOST_FLIP:
        return float(value)
    raise ValueError(f"expected {', '.join(Preset)}, or a mean FLIP above 0 and up to {MOST_FLIP}, not {value!r}")


Quality = Annotated[Preset | float, BeforeValidator(_check_quality)]
"""A preset, or the mean FLIP that every category is to keep to."""


class Budget(Model):
    """The limits that settings must keep to for a picture to have a quality.

    Attributes:
        flip: the greatest mean FLIP.
        psnr_db: the least peak signal over noise.
        samples: the least number of samples a pixel. With fewer, cables are ragged or smeared, which a mean over a
            picture that is mostly something else does not tell.
    """

    flip: float
    psnr_db: float = 0.0
    samples: int = 1


class CalibratedSettings(Model):
    """Settings, with their time and error as measured over a category's calibration scenes.

    Attributes:
        settings: settings that were measured.
        seconds: time to build and render a scene on the machine of the calibration; good only to compare.
        flip: mean FLIP of a picture, mean over the scenes.
        psnr_db: peak signal over noise, mean over the scenes.
    """

    settings: PictureSettings
    seconds: Annotated[float, Field(gt=0)]
    flip: Annotated[float, Field(ge=0)]
    psnr_db: float


class Calibration(Model):
    """The measured settings of each category. None of a category's settings is both faster and better than another.

    Attributes:
        version: version of this format.
        measured_on: the machine, in words.
        samples: samples a pixel of the references.
        scenes: number of scenes of each category.
        categories: the settings by category; one without any is rendered as a reference alone.
    """

    version: int
    measured_on: str
    samples: int
    scenes: int
    categories: Mapping[Category, tuple[CalibratedSettings, ...]]


class ChosenSettings(Model):
    """The settings chosen for a category's pictures.

    Attributes:
        settings: settings to render with.
        expected_flip: the mean FLIP to expect; None where the settings are the reference's.
    """

    settings: PictureSettings
    expected_flip: float | None


STANDARD_SAMPLES = 6
"""The least samples a pixel where a floor is rendered behind the cables."""

BACKDROP_SAMPLES = 4
"""The least samples a pixel where cables are laid over a backdrop: how much of a pixel they cover is exact with any
number."""

REFERENCE = PictureSettings(
    cycles=CyclesSettings(
        samples=1024,
        bounces=12,
        diffuse_bounces=4,
        glossy_bounces=4,
        caustics=True,
        denoiser=Denoiser.NONE,
        world_map_px=0,
    ),
    detail=CableDetail(sides=40, points_per_segment=10),
    economy=Economy(cables_in_view=False, texture_window=False, upper_world=False, backdrop=False),
)
"""Settings of the pictures that errors are measured against: nothing is left out, and paths have Blender's limits."""


def read_quality(text: str) -> str | float:
    """Read a flag's value: a number, else a preset's name. The spec checks either."""
    try:
        return float(text)
    except ValueError:
        return text


def budget_of(quality: Quality, category: Category) -> Budget:
    """Make the budget of a quality other than `REFERENCE`; presets grant more to floors under an HDRI, the noisiest."""
    traits = category.traits
    hdri_floor = traits.background is Background.FLOOR and traits.light is Light.DISTRIBUTED
    if quality is Preset.DRAFT:
        return Budget(flip=0.09 if hdri_floor else 0.06)
    samples = BACKDROP_SAMPLES if traits.background is Background.HDRI else STANDARD_SAMPLES
    if isinstance(quality, float):
        return Budget(flip=quality, samples=samples)
    return Budget(flip=0.05 if hdri_floor else 0.03, psnr_db=35.0, samples=samples)


def _keeps_to(row: CalibratedSettings, budget: Budget) -> bool:
    enough = row.settings.cycles.samples >= budget.samples
    return enough and row.flip <= budget.flip and row.psnr_db >= budget.psnr_db


def cheapest(rows: tuple[CalibratedSettings, ...], budget: Budget) -> CalibratedSettings | None:
    """Find the fastest of `rows` within a budget; None if no row is."""
    within = [row for row in rows if _keeps_to(row, budget)]
    return min(within, key=lambda row: row.seconds, default=None)


@lru_cache(maxsize=1)
def calibration() -> Calibration:
    """Read the calibration that comes with the farm, once in a process."""
    return Calibration.model_validate_json(CALIBRATION.read_bytes())


def settings_for(quality: Quality, category: Category) -> ChosenSettings:
    """Choose the settings that a quality means for a category.

    Raises:
        ValueError: if the category has no calibrated settings, or none of them keeps to the budget; the text says what
            to run, or the least that can be asked for.
    """
    if quality is Preset.REFERENCE:
        return ChosenSettings(settings=REFERENCE, expected_flip=None)
    rows = calibration().categories.get(category, ())
    if not rows:
        raise ValueError(
            f"quality {quality}: no settings are calibrated for {category}; run `make bench-render` and copy the "
            f"category's settings from results/calibration.json to {CALIBRATION.name}, or ask for 'reference'"
        )
    found = cheapest(rows, budget_of(quality, category))
    if found is None:
        least = min(row.flip for row in rows)
        raise ValueError(
            f"quality {quality}: no calibrated settings render {category} so well, the least FLIP is {least:.3f}; "
            "for less ask for 'reference'"
        )
    return ChosenSettings(settings=found.settings, expected_flip=found.flip)
