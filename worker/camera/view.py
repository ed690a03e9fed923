"""The camera's geometry: where a point of the scene is in the picture, and what of the floor is seen. Pure numpy."""

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from farm.scene.camera import FOCAL_LENGTH_MM, SENSOR_MM, Camera
from worker.camera.distortion import Distortion
from worker.curves import Points

_LEVEL = 0.05
"""Sine of the least angle with the floor at which it is looked for: rays to the horizon and above end nowhere."""


@dataclass(frozen=True, slots=True)
class View:
    """What a camera that looks at the origin sees through one point of its thin lens.

    All points of the lens see what is in focus at the same place of the picture. Without more than a height it looks
    straight down through the published lens, in focus on the floor.

    Attributes:
        height_m: distance from the origin along the view; the height above the floor where it is not tilted.
        resolution: pixels on each edge of the square picture.
        pinhole_m: the point of the lens, right and up from its middle.
        focal_length_mm: of the lens.
        tilt_deg: between its view and straight down.
        tilt_bearing_deg: to which side it stands, from the x axis.
        roll_deg: how far the camera is turned about its view, counter-clockwise seen from above.
        focus_offset_m: how much nearer than the origin the focus is.
        distortion: radial, at the corner; see `worker.camera.distortion`.
    """

    height_m: float
    resolution: int
    pinhole_m: tuple[float, float] = (0.0, 0.0)
    focal_length_mm: float = FOCAL_LENGTH_MM
    tilt_deg: float = 0.0
    tilt_bearing_deg: float = 0.0
    roll_deg: float = 0.0
    focus_offset_m: float = 0.0
    distortion: float = 0.0

    @classmethod
    def of(cls, camera: Camera, resolution: int) -> Self:
        """Through the middle of a camera's lens."""
        return cls(
            height_m=camera.height_m,
            resolution=resolution,
            focal_length_mm=camera.focal_length_mm,
            tilt_deg=camera.tilt_deg,
            tilt_bearing_deg=camera.tilt_bearing_deg,
            roll_deg=camera.roll_deg,
            focus_offset_m=camera.focus_offset_m,
            distortion=camera.distortion,
        )

    def undistorted(self) -> Self:
        """Through a lens without distortion, which is what Blender renders."""
        return replace(self, distortion=0.0)

    @property
    def rotation(self) -> NDArray[np.float64]:
        """(3, 3): its columns are the world's directions to the right, up, and backwards from what is seen."""
        tilt, bearing, roll = np.radians([self.tilt_deg, self.tilt_bearing_deg, self.roll_deg])
        x, y = -math.sin(bearing), math.cos(bearing)
        # Rodrigues' formula about a level axis (x, y, 0).
        sine, rest = math.sin(tilt), 1.0 - math.cos(tilt)
        tilted = np.array(
            [
                [1.0 - rest * y * y, rest * x * y, sine * y],
                [rest * x * y, 1.0 - rest * x * x, -sine * x],
                [-sine * y, sine * x, 1.0 - rest],
            ]
        )
        rolled = np.array([[math.cos(roll), -math.sin(roll), 0], [math.sin(roll), math.cos(roll), 0], [0, 0, 1]])
        turned: NDArray[np.float64] = tilted @ rolled
        return turned

    @property
    def position_m(self) -> NDArray[np.float64]:
        """Of the lens's middle in the world, (3,)."""
        behind: NDArray[np.float64] = self.height_m * self.rotation[:, 2]
        return behind

    @property
    def eye_m(self) -> NDArray[np.float64]:
        """Of the point of the lens that is looked through, in the world, (3,)."""
        eye: NDArray[np.float64] = self.position_m + self.rotation[:, :2] @ self.pinhole_m
        return eye

    @property
    def focus_m(self) -> float:
        """Distance in focus, along the view."""
        return self.height_m - self.focus_offset_m

    @property
    def focal_length_px(self) -> float:
        """Pixels for a slope of 1 across the view."""
        return self.resolution * self.focal_length_mm / SENSOR_MM

    @property
    def pixels_per_m(self) -> float:
        """Where it looks at the floor, across the view."""
        return self.focal_length_px / self.height_m

    def depths_m(self, points: Points) -> NDArray[np.float64]:
        """Distances along the view (N,) of points (N, 3); what is behind the camera has none above 0."""
        depths: NDArray[np.float64] = -((points - self.position_m) @ self.rotation[:, 2])
        return depths

    def project(self, points: Points) -> NDArray[np.float64]:
        """Pixel coordinates (N, 2) of points (N, 3); the top left corner of the picture is (0, 0).

        At depth z a ray through the lens at l meets the plane in focus, at distance D, at l (1 - D / z) + p D / z, with
        l and p counted from the axis of view.
        """
        seen = (points - self.position_m) @ self.rotation
        nearer = self.focus_m / -seen[:, 2:]
        in_focus = np.multiply(self.pinhole_m, 1.0 - nearer) + nearer * seen[:, :2]
        from_middle = self.focal_length_px / self.focus_m * in_focus * [1.0, -1.0]
        if self.distortion:
            corner = self.resolution * math.sqrt(0.5)
            from_middle = corner * Distortion(self.distortion).move(from_middle / corner)
        placed: NDArray[np.float64] = self.resolution / 2 + from_middle
        return placed

    def floor_corners_m(self, margin: float = 0.0) -> Points:
        """Where the lines of sight of the picture's corners meet the floor, (4, 3).

        A distorted picture shows no more than this, see `worker.camera.distortion`.

        Args:
            margin: of the picture's width, by which it is taken larger on each side.
        """
        reach = (0.5 + margin) * SENSOR_MM / self.focal_length_mm
        rays = np.array([[x, y, -1.0] for x, y in ((-reach, -reach), (reach, -reach), (reach, reach), (-reach, reach))])
        towards = rays @ self.rotation.T
        down = np.maximum(-towards[:, 2], _LEVEL * np.linalg.norm(towards, axis=1))
        met: Points = self.position_m + (self.position_m[2] / down)[:, None] * towards
        return met

    @property
    def steepest_slope(self) -> float:
        """Greatest sideways reach of the picture's lines of sight on their way to the floor, over the camera's height.

        By so much of its height what stands on the floor hides, at most, what lies behind it.
        """
        aside = self.floor_corners_m()[:, :2] - self.position_m[:2]
        return float(np.linalg.norm(aside, axis=1).max() / self.position_m[2])
