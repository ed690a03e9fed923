"""The categories of picture: background, light and disposition. A new one is a member and a row of traits here."""

from dataclasses import dataclass
from enum import StrEnum


class Background(StrEnum):
    """The kind of background behind the cables."""

    FLOOR = "floor"
    HDRI = "hdri"


class Light(StrEnum):
    """The kind of light in the scene: one lamp in a grey world, or the HDRI alone."""

    CONCENTRATED = "concentrated"
    DISTRIBUTED = "distributed"


class Disposition(StrEnum):
    """The arrangement of the cables before they fall."""

    FREE = "free"
    ALIGNED = "aligned"


@dataclass(frozen=True, slots=True)
class CategoryTraits:
    """Traits of a category: the kinds of scene that it has, and its share of a dataset.

    Attributes:
        background: kind of background behind the cables.
        light: kind of light in the scene.
        disposition: arrangement of the cables before they fall.
        weight: share of a total number of images, in tenths of the published 25,000; 0 for a category that the
            publication has not, which gets images by a quota of its own alone.
        code: the integer that stands for the category in every seed of its jobs. It never changes and is never used
            again.
    """

    background: Background
    light: Light
    disposition: Disposition
    weight: int
    code: int


class Category(StrEnum):
    """A category; its value is the folder's name."""

    CLOSE_CONCENTRATED = "close_concentrated_light"
    CLOSE_ALIGNED_CONCENTRATED = "close_aligned_concentrated_light"
    CLOSE_DISTRIBUTED = "close_distributed_light"
    CLOSE_ALIGNED_DISTRIBUTED = "close_aligned_distributed_light"
    FAR = "far"
    FAR_ALIGNED = "far_aligned"

    @property
    def traits(self) -> CategoryTraits:
        """The category's traits."""
        return _TRAITS[self]

    @property
    def code(self) -> int:
        """The integer that stands for the category in every seed of its jobs."""
        return self.traits.code


_TRAITS = {
    Category.CLOSE_CONCENTRATED: CategoryTraits(
        Background.FLOOR, Light.CONCENTRATED, Disposition.FREE, weight=2, code=0
    ),
    Category.CLOSE_ALIGNED_CONCENTRATED: CategoryTraits(
        Background.FLOOR, Light.CONCENTRATED, Disposition.ALIGNED, weight=2, code=1
    ),
    Category.CLOSE_DISTRIBUTED: CategoryTraits(Background.FLOOR, Light.DISTRIBUTED, Disposition.FREE, weight=1, code=2),
    Category.CLOSE_ALIGNED_DISTRIBUTED: CategoryTraits(
        Background.FLOOR, Light.DISTRIBUTED, Disposition.ALIGNED, weight=1, code=3
    ),
    Category.FAR: CategoryTraits(Background.HDRI, Light.DISTRIBUTED, Disposition.FREE, weight=2, code=4),
    Category.FAR_ALIGNED: CategoryTraits(Background.HDRI, Light.DISTRIBUTED, Disposition.ALIGNED, weight=2, code=5),
}
