"""Styles: named sets of ranges. A description names one and overrides what it wants to have otherwise."""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from farm.ranges import Ranges


class Style(StrEnum):
    """What pictures are to look like: as the published ones, or as varied as photographs are."""

    PUBLISHED = "published"
    WIDE = "wide"


WIDE = Ranges()

RANGES_OF: Mapping[Style, Ranges] = MappingProxyType({Style.PUBLISHED: Ranges(), Style.WIDE: WIDE})
"""Every range of each style."""


def merge_ranges(style: Style, overrides: Mapping[str, object]) -> dict[str, object]:
    """The ranges of a style with some of them overridden, as plain values; nothing is validated yet.

    Args:
        style: whose ranges hold where none is given.
        overrides: tables of ranges, nested as in `Ranges`.
    """
    return _merge(RANGES_OF[style].model_dump(mode="json"), overrides)


def _merge(base: Mapping[str, object], overrides: Mapping[str, object]) -> dict[str, object]:
    merged = dict(base)
    for key, value in overrides.items():
        present = merged.get(key)
        both = isinstance(present, Mapping) and isinstance(value, Mapping)
        merged[key] = _merge(present, value) if both else value  # type: ignore[arg-type]  # both are mappings here
    return merged
