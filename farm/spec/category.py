"""The six categories of picture: background x light x disposition."""

from dataclasses import dataclass
from enum import StrEnum


class Background(StrEnum):
    """What is seen behind the cables."""

    FLOOR = "floor"
    HDRI = "hdri"


class Light(StrEnum):
    """What lights the scene: one lamp in a grey world, or the HDRI alone."""

    CONCENTRATED = "concentrated"
    DISTRIBUTED = "distributed"


class Disposition(StrEnum):
    """How the cables lie to each other before they fall."""

    FREE = "free"
    ALIGNED = "aligned"


@dataclass(frozen=True, slots=True)
class CategoryTraits:
    """What a category fixes of a scene, and its share of the published 25,000 images."""

    background: Background
    light: Light
    disposition: Disposition
    weight: int


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
        """What this category fixes of a scene."""
        return _TRAITS[self]

    @property
    def code(self) -> int:
        """A small integer that never changes: it takes part in every seed of the category's jobs."""
        return _CODES[self]


_TRAITS = {
    Category.CLOSE_CONCENTRATED: CategoryTraits(Background.FLOOR, Light.CONCENTRATED, Disposition.FREE, 2),
    Category.CLOSE_ALIGNED_CONCENTRATED: CategoryTraits(Background.FLOOR, Light.CONCENTRATED, Disposition.ALIGNED, 2),
    Category.CLOSE_DISTRIBUTED: CategoryTraits(Background.FLOOR, Light.DISTRIBUTED, Disposition.FREE, 1),
    Category.CLOSE_ALIGNED_DISTRIBUTED: CategoryTraits(Background.FLOOR, Light.DISTRIBUTED, Disposition.ALIGNED, 1),
    Category.FAR: CategoryTraits(Background.HDRI, Light.DISTRIBUTED, Disposition.FREE, 2),
    Category.FAR_ALIGNED: CategoryTraits(Background.HDRI, Light.DISTRIBUTED, Disposition.ALIGNED, 2),
}

_CODES = {
    Category.CLOSE_CONCENTRATED: 0,
    Category.CLOSE_ALIGNED_CONCENTRATED: 1,
    Category.CLOSE_DISTRIBUTED: 2,
    Category.CLOSE_ALIGNED_DISTRIBUTED: 3,
    Category.FAR: 4,
    Category.FAR_ALIGNED: 5,
}
