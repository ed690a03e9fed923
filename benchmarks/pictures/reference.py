"""Figures of the published examples and of photographs, from Malvido Fresnillo et al., 2024, or measured on them."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Range:
    """A range from `low` to `high`, both included."""

    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether a value lies in the range; NaN never does."""
        return self.low <= value <= self.high


PUBLISHED: Mapping[str, Range] = {
    "coverage": Range(0.11, 0.13),
    "grey_level": Range(81, 121),
    "grey_deviation": Range(26, 42),
    "width_px": Range(6, 18),
}
"""Ranges of the categories' means over the 180 published examples, by figure."""

PHOTOGRAPHS: Mapping[str, Range] = {
    "grey_level": Range(134 - 22, 134 + 22),
    "grey_deviation": Range(51, 51),
    "width_px": Range(7, 22),
}
"""Ranges of photographs of real cables, by figure."""

WIDE: Mapping[str, Range] = {"grey_level": Range(60, 200), "grey_deviation": Range(20, 75)}
"""Ranges that the pictures of style `wide` promise to cover, by figure."""
