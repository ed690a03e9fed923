"""The colour of light of a given temperature. Pure numpy."""

import numpy as np
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE

_WAVELENGTHS_NM = np.arange(360.0, 831.0, 5.0)
"""Wavelengths of visible light, in nanometres, over which spectra are summed."""

_SECOND_RADIATION_NM_K = 1.438776877e7
"""Second radiation constant h c / k, in nanometre kelvins (CODATA 2018)."""

_REC709_OF_XYZ = np.array(
    [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]
)
"""Matrix from CIE XYZ to linear Rec. 709 (IEC 61966-2-1)."""


def black_body(temperature_k: float) -> NDArray[np.float64]:
    """Compute the colour of a black body. Below 1,900 K it is redder than Rec. 709 can show, and is clipped.

    Args:
        temperature_k: temperature in kelvins, 1,000 to 20,000.

    Returns:
        (3,) linear Rec. 709, with a luminance of 1.
    """
    wavelength = _WAVELENGTHS_NM
    # Planck's law but for a factor, which the division by the luminance removes.
    spectrum = wavelength**-5.0 / np.expm1(_SECOND_RADIATION_NM_K / (wavelength * temperature_k))
    colour = np.maximum(_REC709_OF_XYZ @ (_colour_matching(wavelength) @ spectrum), 0.0)
    bright: NDArray[np.float64] = colour / (REC709_LUMINANCE @ colour)
    return bright


def _colour_matching(wavelength_nm: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the CIE 1931 colour matching functions (3, N) at wavelengths (N,) in nanometres.

    Source: the fit of Wyman, Sloan and Shirley, JCGT 2 (2), 2013, eq. 4.
    """

    def lobe(height: float, middle: float, below: float, above: float) -> NDArray[np.float64]:
        width = np.where(wavelength_nm < middle, below, above)
        bell: NDArray[np.float64] = height * np.exp(-0.5 * ((wavelength_nm - middle) * width) ** 2)
        return bell

    x = lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323) + lobe(-0.065, 501.1, 0.0490, 0.0382)
    y = lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322)
    z = lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)
    return np.stack([x, y, z])
