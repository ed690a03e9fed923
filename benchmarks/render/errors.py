"""The error of a picture against its reference."""

from dataclasses import dataclass

import flip_evaluator
import numpy as np
from numpy.typing import NDArray

_LEAST_MSE = 1e-12
"""Least mean square error, of levels from 0 to 1: it bounds the PSNR of equal pictures to 120 dB."""


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of one picture.

    Attributes:
        flip: mean of NVIDIA's FLIP over the picture, 0 to 1, at its default viewing distance (67 pixels a degree).
        psnr_db: peak signal-to-noise ratio of the sRGB levels, dB.
    """

    flip: float
    psnr_db: float


def errors(picture: NDArray[np.uint8], reference: NDArray[np.uint8]) -> Errors:
    """Compare a picture with its reference, both (H, W, 3) sRGB."""
    ours, theirs = picture.astype(np.float32) / 255.0, reference.astype(np.float32) / 255.0
    square = float(np.mean((ours.astype(np.float64) - theirs) ** 2))
    _, flip, _ = flip_evaluator.evaluate(theirs, ours, "LDR")
    return Errors(flip=float(flip), psnr_db=float(10 * np.log10(1.0 / max(square, _LEAST_MSE))))
