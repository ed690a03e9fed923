"""The camera's geometry: the place of a scene's point in the picture, and the visible part of the floor. Pure numpy."""

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from farm.scene.camera import FOCAL_LENGTH_MM, SENSOR_MM, Camera
from farm.scene.picture_size import PictureSize
from worker.camera.distortion import Distortion
from worker.curves import Points

_LEVEL = 0.05
"""Sine of the smallest angle between a line of sight and the floor; flatter lines, which may miss it, get this one."""


@dataclass(frozen=True, slots=True)
class View:
    """The view of a camera that looks at the origin, through one point of its thin lens.

    All points of the lens see an object in focus at the same place of the picture. With a height and a resolution
    alone, the camera looks straight down through a lens of `FOCAL_LENGTH_MM`, in focus on the floor.

    Attributes:
        height_m: distance from the origin along the view, in metres; without tilt the height above the floor.
        resolution: size of the picture, in pixels.
        pinhole_m: point of the lens, to the right and up from its middle, in metres.
        focal_length_mm: focal length on a sensor whose longer edge is 36 mm.
        tilt_deg: angle between the view and straight down, in degrees.
        tilt_bearing_deg: bearing of the side to which a tilted camera stands, in degrees from the x axis.
        roll_deg: rotation about the view, in degrees, counter-clockwise seen from above.
        focus_offset_m: distance by which the focus is nearer than the origin, in metres.
        distortion: radial distortion at the corner; see `worker.camera.distortion`.
    """

    height_m: float
    resolution: PictureSize
    pinhole_m: tuple[float, float] = (0.0, 0.0)
    focal_length_mm: float = FOCAL_LENGTH_MM
    tilt_deg: float = 0.0
    tilt_bearing_deg: float = 0.0
    roll_deg: float = 0.0
    focus_offset_m: float = 0.0
    distortion: float = 0.0

    @classmethod
    def of(cls, camera: Camera, resolution: PictureSize) -> Self:
        """Make the view through the middle of a camera's lens.

        Args:
            camera: camera of a scene.
            resolution: size of the picture, in pixels.
        """
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
        """Make the same view through a lens without distortion, which is what Blender renders."""
        return replace(self, distortion=0.0)

    @property
    def rotation(self) -> NDArray[np.float64]:
        """Orientation of the camera, (3, 3): its columns are the directions right, up and backwards in the world."""
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
        """Position of the lens's middle in the world, (3,) metres."""
        behind: NDArray[np.float64] = self.height_m * self.rotation[:, 2]
        return behind

    @property
    def eye_m(self) -> NDArray[np.float64]:
        """Position of the lens's point in the world, (3,) metres."""
        eye: NDArray[np.float64] = self.position_m + self.rotation[:, :2] @ self.pinhole_m
        return eye

    @property
    def focus_m(self) -> float:
        """Distance of the focus along the view, in metres."""
        return self.height_m - self.focus_offset_m

    @property
    def focal_length_px(self) -> float:
        """Focal length in pixels."""
        return self.resolution.longer * self.focal_length_mm / SENSOR_MM

    @property
    def pixels_per_m(self) -> float:
        """Number of pixels in a metre across the view, at the origin."""
        return self.focal_length_px / self.height_m

    def depths_m(self, points: Points) -> NDArray[np.float64]:
        """Compute the distances (N,) of points (N, 3) along the view, all in metres; below 0 is behind the camera."""
        depths: NDArray[np.float64] = -((points - self.position_m) @ self.rotation[:, 2])
        return depths

    def project(self, points: Points) -> NDArray[np.float64]:
        """Project points into the picture.

        A ray from a point p at depth z through the lens at l meets the plane in focus, at distance D, at
        l (1 - D / z) + p D / z, with l and p measured from the axis of view.

        Args:
            points: (N, 3) metres, before the camera.

        Returns:
            (N, 2) pixels, to the right and down from the picture's top left corner.
        """
        seen = (points - self.position_m) @ self.rotation
        nearer = self.focus_m / -seen[:, 2:]
        in_focus = np.multiply(self.pinhole_m, 1.0 - nearer) + nearer * seen[:, :2]
        from_middle = self.focal_length_px / self.focus_m * in_focus * [1.0, -1.0]
        if self.distortion:
            lens = Distortion(self.distortion, self.resolution)
            from_middle = lens.corner_px * lens.move(from_middle / lens.corner_px)
        placed: NDArray[np.float64] = np.array([self.resolution.width / 2, self.resolution.height / 2]) + from_middle
        return placed

    def floor_corners_m(self, margin: float = 0.0) -> Points:
        """Compute where the lines of sight of the picture's corners meet the floor.

        A distorted picture shows no more than this; see `worker.camera.distortion`.

        Args:
            margin: margin on each side, as a share of the picture's longer edge.

        Returns:
            (4, 3) metres.
        """
        right, up = ((0.5 * share + margin) * SENSOR_MM / self.focal_length_mm for share in self.resolution.shares)
        rays = np.array([[x, y, -1.0] for x, y in ((-right, -up), (right, -up), (right, up), (-right, up))])
        towards = rays @ self.rotation.T
        down = np.maximum(-towards[:, 2], _LEVEL * np.linalg.norm(towards, axis=1))
        met: Points = self.position_m + (self.position_m[2] / down)[:, None] * towards
        return met

    def lowest_opening_m(self, near_m: float, lens_radius_m: float) -> float:
        """Compute the height above the floor, in metres, below which nothing is too near for the picture.

        It is the lowest point of the plane at which the view begins, between the picture's corners and for every point
        of the lens. It may be negative.

        Args:
            near_m: distance along the view at which it begins, in metres.
            lens_radius_m: radius of the lens's aperture, in metres.
        """
        corners = self.floor_corners_m()
        drop = (self.position_m[2] - corners[:, 2]) * near_m / self.depths_m(corners)
        tilt = float(np.linalg.norm(self.rotation[2, :2]))
        return float(self.position_m[2] - drop.max() - lens_radius_m * tilt)

    @property
    def steepest_slope(self) -> float:
        """Largest horizontal length of the lines of sight to the floor, over the camera's height above it.

        An object on the floor hides what lies behind it over at most this multiple of the object's height.
        """
        aside = self.floor_corners_m()[:, :2] - self.position_m[:2]
        return float(np.linalg.norm(aside, axis=1).max() / self.position_m[2])
