"""What is known of the published examples and of photographs (Malvido Fresnillo et al., 2024, and measured on them)."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Range:
    """From `low` to `high`, both included."""

    low: float
    high: float

    def holds(self, value: float) -> bool:
        """Whether a value lies in it; NaN never does."""
        return self.low <= value <= self.high


PUBLISHED: Mapping[str, Range] = {
    "coverage": Range(0.11, 0.13),
    "grey_level": Range(81, 121),
    "grey_deviation": Range(26, 42),
    "width_px": Range(6, 18),
}
"""By figure, of the 180 published examples."""

PHOTOGRAPHS: Mapping[str, Range] = {
    "grey_level": Range(134 - 22, 134 + 22),
    "grey_deviation": Range(51, 51),
    "width_px": Range(7, 22),
}
"""By figure, of photographs of real cables."""

WIDE: Mapping[str, Range] = {"grey_level": Range(60, 200), "grey_deviation": Range(20, 75)}
"""By figure, what the pictures of style `wide` promise to cover."""
