"""The camera, its lens, and what the sensor and its electronics make of the light."""

from typing import Annotated, Final

from pydantic import Field

from farm.model import Model, Share

FOCAL_LENGTH_MM: Final = 50.0


SENSOR_MM: Final = 36.0
"""Edge of the square sensor."""


class Camera(Model):
    """A camera that looks at the origin. In focus is what is as far along its view, but for `focus_offset_m`.

    Attributes:
        height_m: distance from the point of the floor at which it looks; its height where it is not tilted.
        focal_length_mm: on a sensor of 36 mm.
        tilt_deg: between its view and straight down.
        tilt_bearing_deg: to which side it stands, from the x axis.
        roll_deg: about its view, counter-clockwise seen from above.
        focus_offset_m: how much nearer than the origin the focus is.
    """

    height_m: Annotated[float, Field(gt=0)]
    f_number: Annotated[float, Field(gt=0)]
    focal_length_mm: Annotated[float, Field(gt=0)] = FOCAL_LENGTH_MM
    tilt_deg: Annotated[float, Field(ge=0, le=30)] = 0.0
    tilt_bearing_deg: float = 0.0
    roll_deg: float = 0.0
    focus_offset_m: float = 0.0
    distortion: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0
    """Radial: how much farther out a corner of the picture is than a lens without any has it, before the picture is
    scaled to be just filled; negative is a barrel."""

    @property
    def seen_m(self) -> float:
        """Width of the floor in the picture, as an untilted lens without distortion sees it."""
        return self.height_m * SENSOR_MM / self.focal_length_mm


UNCOMPRESSED_FROM = 100
"""JPEG quality from which on a picture is left as it is. It is the highest that a description may ask for."""

NO_JPEG = 101
"""JPEG quality of a scene whose camera was drawn to write no JPEG, which tells it from one that was drawn at 100."""


class Development(Model):
    """From light on the sensor to 8 bits a channel, as a camera does it.

    Attributes:
        key: linear level, 0 to 1, to which the exposure brings the picture's mean; see `worker.camera.develop.expose`.
        exposure_ev: the exposure's error, in stops.
        contrast: slope of the tone curve at mid-grey over that of the plain sRGB curve.
        saturation: 1 leaves colours as they are.
        white_balance: error of the camera's own, as gains of red and blue.
        vignetting: share of the light that is lost in the corners.
        chromatic_aberration: how much larger the red picture is than the green, and the blue smaller, as a share.
        full_well: electrons of a white pixel: fewer make more shot noise; 0 is no noise at all.
        read_noise: electrons.
        sharpening: amount of the unsharp mask.
        jpeg_quality: quality of the JPEG that the picture goes through; none from `UNCOMPRESSED_FROM` on.
        seed: of the noise.
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
