"""Colours of black bodies."""

import numpy as np
import pytest
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE
from worker.camera.black_body import black_body

_XYZ_OF_REC709 = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)


def chromaticity(colour: NDArray[np.float64]) -> NDArray[np.float64]:
    """The chromaticity, CIE x and y."""
    tristimulus = _XYZ_OF_REC709 @ colour
    found: NDArray[np.float64] = tristimulus[:2] / tristimulus.sum()
    return found


@pytest.mark.parametrize(
    ("temperature", "x", "y"),
    [
        (2000, 0.5267, 0.4133),
        (2856, 0.4476, 0.4074),
        (4000, 0.3805, 0.3768),
        (6504, 0.3135, 0.3237),
        (10_000, 0.2807, 0.2884),
    ],
)
def test_chromaticities_are_those_of_the_planckian_locus(temperature: float, x: float, y: float) -> None:
    """Tabulated values (Wyszecki and Stiles; 2856 K is illuminant A) are met within the fit of the eye's response."""
    assert chromaticity(black_body(temperature)) == pytest.approx([x, y], abs=0.004)


@pytest.mark.parametrize("temperature", [1000, 1900, 6500, 20_000])
def test_the_luminance_is_1(temperature: float) -> None:
    """The luminance is 1 for every colour, and no channel is negative."""
    colour = black_body(temperature)
    assert REC709_LUMINANCE @ colour == pytest.approx(1.0)
    assert colour.min() >= 0.0


def test_hotter_is_bluer() -> None:
    """Blue over red rises with the temperature over the whole range."""
    shares = [black_body(t)[2] / black_body(t)[0] for t in range(2000, 20_001, 500)]
    assert (np.diff(shares) > 0).all()
