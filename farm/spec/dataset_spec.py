"""The description of a dataset, complete: a user's TOML file and flags with every default filled in."""

from collections.abc import Iterator, Mapping
from enum import StrEnum
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, model_validator

from farm.model import Model
from farm.scene.picture_size import PictureSize, can_be_made
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.quality import Preset, Quality, settings_for
from farm.spec.ranges.all import Ranges
from farm.spec.simulation import AskedSimulator, Fall, Simulator
from farm.spec.styles import Style

Quota = Annotated[int, Field(ge=0, le=10**7)]


DEFAULT_STYLE = Style.WIDE

_MOST_CLOTH_CABLES = 8
"""Cables of a picture that Blender's cloth brings to rest; of four scenes of 24 every one failed its checks."""


class Engine(StrEnum):
    """Blender's render engine."""

    CYCLES = "cycles"
    EEVEE = "eevee"


class DatasetSpec(Model):
    """The description of a dataset.

    Attributes:
        version: version of this format.
        seed: seed of every random value in the dataset.
        quotas: number of images of each of the six categories; `parse_spec` fills it in from a total.
        resolution: size of the pictures, in pixels.
        engine: Blender's render engine.
        quality: preset, or mean FLIP that the pictures keep to.
        close_distributed_hdri: name of the HDRI that lights all pictures over a floor without a lamp, if
            `ranges.world.one_over_floors`; None for the default one.
        style: named set of ranges that `ranges` starts from.
        simulator: simulator of the cables' fall.
        fall: settings of the fall.
        ranges: range of every random value; `parse_spec` fills it in from the style.
    """

    version: Literal[1] = 1
    seed: Annotated[int, Field(ge=0, lt=2**64)] = 0
    quotas: Mapping[Category, Quota]
    resolution: Annotated[PictureSize, AfterValidator(can_be_made)] = PictureSize.square(512)
    engine: Engine = Engine.CYCLES
    quality: Quality = Preset.STANDARD
    close_distributed_hdri: str | None = None
    style: Style = Style.PUBLISHED
    simulator: AskedSimulator = Simulator.ROD
    fall: Fall = Fall()
    ranges: Ranges = Ranges()

    @model_validator(mode="after")
    def _asks_for_something(self) -> "DatasetSpec":
        if self.total == 0:
            raise ValueError("the quotas add up to zero images; ask for at least one")
        return self

    @model_validator(mode="after")
    def _can_be_simulated(self) -> "DatasetSpec":
        most = self.ranges.cable.count[1]
        if self.simulator is Simulator.CLOTH and most > _MOST_CLOTH_CABLES:
            raise ValueError(
                f"ranges.cable.count {most} is above the {_MOST_CLOTH_CABLES} cables that simulator 'cloth' brings to "
                "rest; ask for 'rod', or for fewer"
            )
        share = self.ranges.placement.tangle.share
        if self.simulator is Simulator.CLOTH and share > 0:
            raise ValueError(
                f"ranges.placement.tangle asks for tangles in {share:g} of the pictures, and simulator 'cloth' can't "
                "hold a tangle; ask for 'rod', or leave its shares at 0"
            )
        return self

    @model_validator(mode="after")
    def _can_be_rendered_so_well(self) -> "DatasetSpec":
        if isinstance(self.quality, float) and self.engine is not Engine.CYCLES:
            raise ValueError("quality as a number is measured for engine 'cycles' alone; name a preset")
        if self.engine is Engine.CYCLES:
            for category in (category for category, quota in self.quotas.items() if quota):
                settings_for(self.quality, category)  # raises ValueError if the calibration has none
        return self

    @property
    def total(self) -> int:
        """Number of images of all categories."""
        return sum(self.quotas.values())

    def jobs(self) -> Iterator[Job]:
        """Yield every job of the dataset, by index, and for each index by category.

        A dataset that is stopped early then has images of all categories.
        """
        for numerator in range(max(self.quotas.values())):
            for category, quota in self.quotas.items():
                if numerator < quota:
                    yield Job.model_construct(category=category, index=numerator)
