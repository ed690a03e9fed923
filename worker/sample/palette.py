"""Samples the colours of sheaths: from the common codes of wires, from neutral colours, or from all colours.

The codes name colours, not their coordinates. The sRGB levels here are typical of PVC sheaths in those colours; each
sample deviates a little, as batches and makers do.
"""

from collections.abc import Sequence

import numpy as np

from farm.model import Rgb
from farm.spec.ranges.cable import PaletteRanges
from worker.sample.values import rgb

_WHITE, _BROWN, _GREEN, _YELLOW = (232, 230, 222), (98, 60, 36), (28, 122, 58), (238, 200, 34)
_GREY, _PINK, _BLUE, _RED = (132, 134, 136), (226, 140, 160), (28, 76, 164), (188, 30, 34)
_BLACK, _VIOLET, _ORANGE, _TURQUOISE = (26, 26, 28), (110, 64, 140), (230, 110, 28), (40, 170, 170)
_GOLD, _SILVER = (176, 142, 70), (172, 174, 178)

DIN_47100: Sequence[tuple[Rgb, Rgb | None]] = (
    (_WHITE, None),
    (_BROWN, None),
    (_GREEN, None),
    (_YELLOW, None),
    (_GREY, None),
    (_PINK, None),
    (_BLUE, None),
    (_RED, None),
    (_BLACK, None),
    (_VIOLET, None),
    (_GREY, _PINK),
    (_RED, _BLUE),
    (_WHITE, _GREEN),
    (_BROWN, _GREEN),
    (_WHITE, _YELLOW),
    (_YELLOW, _BROWN),
    (_WHITE, _GREY),
    (_GREY, _BROWN),
    (_WHITE, _PINK),
    (_PINK, _BROWN),
    (_WHITE, _BLUE),
    (_BROWN, _BLUE),
    (_WHITE, _RED),
    (_BROWN, _RED),
    (_WHITE, _BLACK),
    (_BROWN, _BLACK),
)
"""Colours of the first 26 wires of a cable by DIN 47100, sRGB levels: from the eleventh wire on, two colours each."""

IEC_60757: Sequence[Rgb] = (
    _BLACK,
    _BROWN,
    _RED,
    _ORANGE,
    _YELLOW,
    _GREEN,
    _BLUE,
    _VIOLET,
    _GREY,
    _WHITE,
    _PINK,
    _GOLD,
    _TURQUOISE,
    _SILVER,
)
"""Colours of IEC 60757, sRGB levels, in the order BK BN RD OG YE GN BU VT GY WH PK GD TQ SR."""

GREEN_YELLOW: tuple[Rgb, Rgb] = (_GREEN, _YELLOW)
"""The two colours of the protective conductor (GNYE), sRGB levels."""

_BATCH_LEVELS = 9.0
"""Standard deviation of each channel between batches of a colour, in sRGB levels."""


def sample_colours(ranges: PaletteRanges, rng: np.random.Generator) -> tuple[Rgb, Rgb]:
    """Sample the colour of a sheath, and the colour of a stripe on it.

    Args:
        ranges: weights of the palettes; if all are 0, every colour may come.
        rng: random generator of the look.

    Returns:
        The two colours, sRGB levels.
    """
    weights = np.array([ranges.uniform_rgb, ranges.neutral, ranges.din_47100, ranges.iec_60757])
    total = float(weights.sum())
    which = int(rng.choice(4, p=weights / total)) if total > 0 else 0
    if which == 0:
        return rgb(rng, (0, 255)), rgb(rng, (0, 255))
    if which == 1:
        return _neutral(rng), _neutral(rng) if rng.random() < 0.3 else _batch(rng, _any(rng, IEC_60757))
    if which == 2:
        first, second = DIN_47100[int(rng.integers(len(DIN_47100)))]
        return _batch(rng, first), _batch(rng, second or _any(rng, IEC_60757))
    if rng.random() < 0.2:
        return _batch(rng, GREEN_YELLOW[0]), _batch(rng, GREEN_YELLOW[1])
    return _batch(rng, _any(rng, IEC_60757)), _batch(rng, _any(rng, IEC_60757))


def _any(rng: np.random.Generator, colours: Sequence[Rgb]) -> Rgb:
    return colours[int(rng.integers(len(colours)))]


def _neutral(rng: np.random.Generator) -> Rgb:
    """Sample black, white or a grey between them, with weights of 0.45, 0.35 and 0.2."""
    grey = (rng.uniform(14, 45), rng.uniform(205, 245), rng.uniform(60, 190))[int(rng.choice(3, p=[0.45, 0.35, 0.2]))]
    return _batch(rng, (int(grey), int(grey), int(grey)), 3.0)


def _batch(rng: np.random.Generator, colour: Rgb, deviation: float = _BATCH_LEVELS) -> Rgb:
    varied = np.clip(np.rint(np.array(colour) + rng.normal(0.0, deviation, 3)), 0, 255).astype(int)
    return (int(varied[0]), int(varied[1]), int(varied[2]))
