"""The radial distortion of a lens, a map of the picture's plane onto itself, and its inverse. Pure numpy and OpenCV.

Places are relative to the picture's middle, in units in which the corners of the square picture have radius 1.
"""

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

_EDGE = math.sqrt(0.5)
"""Radius of the middle of a picture's edge, where the corners have radius 1."""

_STEPS = 8
"""Number of steps of Newton's method: enough to go from an error of 20 % to the last bit."""

Light = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Distortion:
    """The radial distortion of a lens: r_u = r_d (1 + c r_d^2), and a scale that fills the picture.

    r_u is the radius without distortion, r_d the radius with it. The polynomial goes from the distorted to the
    undistorted radius, the direction in which a picture is looked up; places are moved by its inverse. Beyond the
    corners a straight line continues it, so that it rises everywhere and nothing from outside is folded into the
    picture. The scale is the smallest with which an undistorted square fills the picture: a barrel keeps the corners in
    their place, a pincushion the middles of the edges.

    Attributes:
        at_corner: share by which a corner lies farther from the middle, before the scale; negative is a barrel.
    """

    at_corner: float

    @property
    def _cubic(self) -> float:
        corner = 1.0 + self.at_corner
        return (1.0 / corner - 1.0) / corner**2

    @property
    def _scale(self) -> float:
        edge = float(self._outwards(np.array([_EDGE]))[0])
        return max(1.0 / (1.0 + self.at_corner), _EDGE / edge)

    def move(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Move places (N, 2) in a picture without distortion to where the lens shows them."""
        if self.at_corner == 0.0:
            return places
        radius = np.hypot(places[:, 0], places[:, 1])
        farther = np.divide(self._outwards(radius), radius, out=np.ones_like(radius), where=radius > 0)
        return self._scale * farther[:, None] * places

    def _outwards(self, undistorted: NDArray[np.float64]) -> NDArray[np.float64]:
        """Compute r_d of r_u (N,), before the scale, to the last bits."""
        corner, cubic = 1.0 + self.at_corner, self._cubic
        inside = np.minimum(undistorted, 1.0)
        radius = inside.copy()
        for _ in range(_STEPS):
            radius -= (radius * (1.0 + cubic * radius**2) - inside) / (1.0 + 3.0 * cubic * radius**2)
        beyond: NDArray[np.float64] = radius + (undistorted - inside) / (1.0 + 3.0 * cubic * corner**2)
        return beyond

    def distort(self, light: Light, enlarged: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Light:
        """Distort a picture, with cubic interpolation between pixels.

        Args:
            light: (H, H, 3) linear, from a lens without distortion.
            enlarged: further scale of each channel, for lateral chromatic aberration.

        Returns:
            (H, H, 3) linear, 0 or more, as the lens shows it.
        """
        if self.at_corner == 0.0 and enlarged == (1.0, 1.0, 1.0):
            return light
        if len(set(enlarged)) == 1:
            return self._look_up(light, enlarged[0])
        channels = (
            self._look_up(np.ascontiguousarray(light[..., k]), factor)
            if factor != 1.0 or self.at_corner
            else light[..., k]
            for k, factor in enumerate(enlarged)
        )
        return np.stack(list(channels), axis=-1)

    def _look_up(self, light: Light, enlarged: float) -> Light:
        half = len(light) / 2
        scale = 1.0 / (self._scale * enlarged)
        offset = ((np.arange(len(light)) + 0.5 - half) * scale).astype(np.float32)
        # In pixels the corner's radius is half a diagonal, the square root of twice the square of half an edge.
        squared = offset**2 * np.float32(self._cubic / (2 * half**2))
        farther = 1 + squared[:, None] + squared[None, :]
        middle = np.float32(half - 0.5)
        found: Light = cv2.remap(
            light,
            farther * offset[None, :] + middle,
            farther * offset[:, None] + middle,
            cv2.INTER_CUBIC,
            borderMode=cv2.BORDER_REPLICATE,
        ).astype(np.float32, copy=False)
        return np.maximum(found, 0.0, out=found)
