"""The promises of the two styles, and whether the measured pictures keep them."""

from collections.abc import Mapping
from dataclasses import dataclass

from benchmarks.pictures.reference import PUBLISHED, WIDE
from benchmarks.pictures.survey import Distribution, Summary
from farm.spec.category import Category


@dataclass(frozen=True, slots=True)
class Promise:
    """One promise of a style.

    Attributes:
        style: name of the style.
        what: the figure and the pictures that the promise is about, in words.
        asked: the promised values, in words.
        found: the measured values, in words, with the side that misses.
        kept: whether the promise is kept.
    """

    style: str
    what: str
    asked: str
    found: str
    kept: bool


def promises_of(
    style: str, summaries: Mapping[Category | None, Summary], coverage: Mapping[Category, Distribution]
) -> list[Promise]:
    """The promises of a style; none for a name that isn't a style.

    `published` promises that the mean of each category lies within the range of the published examples. `wide` promises
    that its pictures cover a range: one in twenty lies at or below its lower end, one in twenty at or above its upper
    end.

    Args:
        style: name of the style.
        summaries: summary of all pictures under None, and of each category's.
        coverage: coverage of more scenes than there are pictures, by category; it replaces that of the pictures.
    """
    if style == "published":
        return [
            _within(category, figure, coverage.get(category) if figure == "coverage" else None, summary)
            for category, summary in summaries.items()
            if category is not None
            for figure in PUBLISHED
        ]
    return [_covers(figure, summaries[None]) for figure in WIDE] if style == "wide" else []


def _within(category: Category, figure: str, drawn: Distribution | None, summary: Summary) -> Promise:
    found = drawn or summary.figures[figure]
    asked, mean = PUBLISHED[figure], found.mean
    side = "" if asked.holds(mean) else ", too low" if mean < asked.low else ", too high"
    return Promise(
        "published",
        f"{figure} of {category}",
        f"mean within {asked.low:g} to {asked.high:g}",
        f"{mean:.3g} of {found.pictures}{side}",
        asked.holds(mean),
    )


def _covers(figure: str, summary: Summary) -> Promise:
    asked, found = WIDE[figure], summary.figures[figure]
    low, high = found.p5 <= asked.low, found.p95 >= asked.high
    sides = [side for side, kept in (("lower", low), ("upper", high)) if not kept]
    missed = f", the {' and the '.join(sides)} side misses" if sides else ""
    return Promise(
        "wide",
        figure,
        f"5th percentile at most {asked.low:g}, 95th at least {asked.high:g}",
        f"{found.p5:.3g} and {found.p95:.3g}{missed}",
        low and high,
    )
