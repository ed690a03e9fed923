"""The radial distortion of a lens, a map of the picture's plane onto itself, and its inverse. Pure numpy and OpenCV.

Places are relative to the picture's middle, in units in which the picture's corners have radius 1.
"""

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.scene.picture_size import PictureSize

_STEPS = 8
"""Number of steps of Newton's method: enough to go from an error of 20 % to the last bit."""

Light = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Distortion:
    """The radial distortion of a lens: r_u = r_d (1 + c r_d^2), and a scale that fills the picture.

    r_u is the radius without distortion, r_d the radius with it. The polynomial goes from the distorted to the
    undistorted radius, the direction in which a picture is looked up; places are moved by its inverse. Beyond the
    corners a straight line continues it, so that it rises everywhere and nothing from outside is folded into the
    picture. The scale is the smallest with which an undistorted picture fills the distorted one: a barrel keeps the
    corners in their place, a pincushion the middles of the longer edges, which are the nearest.

    Attributes:
        at_corner: share by which a corner lies farther from the middle, before the scale; negative is a barrel.
        size: size of the picture.
    """

    at_corner: float
    size: PictureSize

    @property
    def corner_px(self) -> float:
        """Distance of the picture's corners from its middle, in pixels."""
        width, height, longer = self.size.width, self.size.height, self.size.longer
        return longer * math.sqrt((width**2 + height**2) / (2 * longer) ** 2)

    @property
    def _nearest(self) -> float:
        """Radius of the middle of the longer edges."""
        return math.sqrt(self.size.shorter**2 / (self.size.width**2 + self.size.height**2))

    @property
    def _cubic(self) -> float:
        corner = 1.0 + self.at_corner
        return (1.0 / corner - 1.0) / corner**2

    @property
    def _scale(self) -> float:
        nearest = self._nearest
        moved = float(self._outwards(np.array([nearest]))[0])
        return max(1.0 / (1.0 + self.at_corner), nearest / moved)

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
            light: (H, W, 3) linear, of the picture's size, from a lens without distortion.
            enlarged: further scale of each channel, for lateral chromatic aberration.

        Returns:
            (H, W, 3) linear, 0 or more, as the lens shows it.
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
        scale = 1.0 / (self._scale * enlarged)
        down, right = (((np.arange(edge) + 0.5 - edge / 2) * scale).astype(np.float32) for edge in self.size.shape)
        # In pixels the corner's radius is half a diagonal.
        bend = np.float32(self._cubic / ((self.size.width**2 + self.size.height**2) / 4))
        farther = 1 + (down**2 * bend)[:, None] + (right**2 * bend)[None, :]
        below, beside = (np.float32(edge / 2 - 0.5) for edge in self.size.shape)
        found: Light = cv2.remap(
            light,
            farther * right[None, :] + beside,
            farther * down[:, None] + below,
            cv2.INTER_CUBIC,
            borderMode=cv2.BORDER_REPLICATE,
        ).astype(np.float32, copy=False)
        return np.maximum(found, 0.0, out=found)
