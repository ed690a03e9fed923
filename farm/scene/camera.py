"""The camera and its lens, and the development of the light on its sensor into a picture."""

from typing import Annotated, Final

from pydantic import Field

from farm.model import Model, Share

FOCAL_LENGTH_MM: Final = 50.0
"""Focal length of the lens in the published style, in millimetres."""

SENSOR_MM: Final = 36.0
"""Longer edge of the sensor, in millimetres: that of 35 mm film, and the default of a Blender sensor."""


NEAR_CLIP_M: Final = 0.005
"""Distance along the view, in metres, up to which the camera sees nothing: that of the farm's own template."""

FAR_CLIP_M: Final = 100.0
"""Distance along the view, in metres, from which on the camera sees nothing. The farthest camera stands at 15 m."""


class Camera(Model):
    """A camera that looks at the origin, in focus at the origin's distance less `focus_offset_m`.

    Attributes:
        height_m: distance from the origin, in metres; without tilt the height above the floor.
        f_number: focal length over the diameter of the aperture.
        focal_length_mm: focal length on a sensor whose longer edge is 36 mm.
        tilt_deg: angle between the view and straight down, in degrees.
        tilt_bearing_deg: bearing of the side to which a tilted camera stands, in degrees from the x axis.
        roll_deg: rotation about the view, in degrees, counter-clockwise seen from above.
        focus_offset_m: distance by which the focus is nearer than the origin, in metres; negative is farther.
    """

    height_m: Annotated[float, Field(gt=0)]
    f_number: Annotated[float, Field(gt=0)]
    focal_length_mm: Annotated[float, Field(gt=0)] = FOCAL_LENGTH_MM
    tilt_deg: Annotated[float, Field(ge=0, le=30)] = 0.0
    tilt_bearing_deg: float = 0.0
    roll_deg: float = 0.0
    focus_offset_m: float = 0.0
    distortion: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0
    """Radial distortion: share by which a corner of the picture lies farther from the middle than without distortion,
    before the picture is scaled so that it is just filled; a negative value is a barrel."""

    @property
    def seen_m(self) -> float:
        """Length of the floor along the picture's longer edge, in metres, without tilt and distortion."""
        return self.height_m * SENSOR_MM / self.focal_length_mm


UNCOMPRESSED_FROM = 100
"""JPEG quality from which on a picture is left as it is. It is the highest that a description may ask for."""

NO_JPEG = 101
"""JPEG quality of a scene whose camera was drawn to write no JPEG, which tells it from one that was drawn at 100."""


class Development(Model):
    """Settings that turn light on the sensor into 8 bits a channel, in the steps of a camera.

    Attributes:
        key: linear level, 0 to 1, to which the exposure brings the picture's mean; see `worker.camera.develop.expose`.
        exposure_ev: error of the exposure, in stops; above 0 the picture is brighter.
        contrast: slope of the tone curve at mid-grey, as a multiple of the sRGB curve's.
        saturation: factor of the colours' distance from grey; 1 leaves them as they are.
        white_balance: error of the white balance, as gains of red and blue.
        vignetting: share of the light that the corners lose.
        chromatic_aberration: share by which the red picture is larger than the green one, and the blue one smaller.
        full_well: electrons of a white pixel: fewer mean more shot noise, and 0 means no noise at all.
        read_noise: standard deviation of the read noise, in electrons.
        sharpening: strength of the unsharp mask; 0 leaves the picture as it is.
        jpeg_quality: quality of the JPEG compression; none from `UNCOMPRESSED_FROM` on.
        seed: seed of the noise.
    """

    key: Annotated[float, Field(gt=0, le=1)]
    exposure_ev: float
    contrast: Annotated[float, Field(gt=0)]
    saturation: Annotated[float, Field(ge=0)]
    white_balance: tuple[Annotated[float, Field(gt=0)], Annotated[float, Field(gt=0)]]
    vignetting: Share
    chromatic_aberration: float
    full_well: Annotated[float, Field(ge=0)]
    read_noise: Annotated[float, Field(ge=0)]
    sharpening: Annotated[float, Field(ge=0)]
    jpeg_quality: Annotated[int, Field(ge=1, le=101)]
    seed: Annotated[int, Field(ge=0, lt=2**63)]
