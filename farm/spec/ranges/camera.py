"""The ranges of the camera, its lens and its sensor.

The published style has an ideal lens, and Blender's view transform in place of a sensor.
"""

import math
from typing import Annotated, Self

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from farm.model import Model
from farm.scene.camera import FOCAL_LENGTH_MM, SENSOR_MM
from farm.scene.floor import FLOOR_REACH_M
from farm.spec.ranges.types import (
    Fraction,
    FractionRange,
    Heights,
    JpegQualityRange,
    NotNegativeRange,
    PositiveRange,
    Range,
    StopsRange,
    both_ends,
    in_order,
)

FNumber = Annotated[float, Field(ge=0.5, le=128)]
FNumberRange = Annotated[
    tuple[FNumber, FNumber], Field(strict=False), BeforeValidator(both_ends), AfterValidator(in_order)
]
FocalLength = Annotated[float, Field(ge=10, le=500)]
Angle = Annotated[float, Field(ge=0, le=30)]
Distortion = Annotated[float, Field(ge=-0.2, le=0.2)]
FocusOffset = Annotated[float, Field(ge=-1, le=0.9)]
Key = Annotated[float, Field(gt=0, le=1)]
Aberration = Annotated[float, Field(ge=-0.05, le=0.05)]


class CameraRanges(Model):
    """The ranges of the camera and its lens. The f-number, lens and tilt are ours.

    Attributes:
        heights_m: heights of a 50 mm lens above the floor, in metres, of which a picture has one; they set the cables'
            size in pixels. Another lens stands at the distance that keeps what the picture's longer edge sees. Above
            1.5 m a picture would show the edge of the floor.
        f_number: focal length over the diameter of the aperture, sampled log-uniformly.
        focal_lengths_mm: focal lengths, in millimetres, of which a picture has one.
        tilt_deg: angle between the camera's view and straight down.
        roll_deg: rotation about the camera's view.
        focus_offset_share: distance by which the focus is nearer than the floor, as a share of the camera's distance.
        distortion: radial distortion at the picture's corner; negative is a barrel.
    """

    heights_m: Annotated[tuple[Heights, ...], Field(min_length=1)] = (
        0.09,
        0.12,
        0.15,
        0.16,
        0.18,
        0.20,
        0.22,
        0.24,
        0.27,
        0.30,
        0.33,
    )
    f_number: FNumberRange = (8.0, 8.0)
    focal_lengths_mm: Annotated[tuple[FocalLength, ...], Field(min_length=1)] = (FOCAL_LENGTH_MM,)
    tilt_deg: Annotated[tuple[Angle, Angle], AfterValidator(in_order)] = (0.0, 0.0)
    roll_deg: Range = (0.0, 0.0)
    focus_offset_share: Annotated[tuple[FocusOffset, FocusOffset], AfterValidator(in_order)] = (0.0, 0.0)
    distortion: Annotated[tuple[Distortion, Distortion], AfterValidator(in_order)] = (0.0, 0.0)

    @model_validator(mode="after")
    def _see_floor_alone(self) -> Self:
        height, tilt = max(self.heights_m), self.tilt_deg[1]
        is_turned = tilt > 0 or self.roll_deg != (0.0, 0.0)
        for focal_length in self.focal_lengths_mm if is_turned else ():
            reach = _farthest_m(height, focal_length, tilt)
            if reach > FLOOR_REACH_M:
                raise ValueError(
                    f"heights_m {height} with a lens of {focal_length:g} mm and tilt_deg {tilt:g} sees "
                    f"{reach:.2g} m of the floor to one side, which reaches {FLOOR_REACH_M} m: lower heights_m or "
                    "tilt_deg, or leave out short focal_lengths_mm"
                )
        return self


def _farthest_m(height_m: float, focal_length_mm: float, tilt_deg: float) -> float:
    """Bound the distance of the picture's corners from the floor's middle, in metres; inf if they see the horizon."""
    distance_m, tilt = height_m * focal_length_mm / FOCAL_LENGTH_MM, math.radians(tilt_deg)
    angle = tilt + math.atan(math.sqrt(0.5) * SENSOR_MM / focal_length_mm)
    if angle >= 0.5 * math.pi:
        return math.inf
    return distance_m * (math.cos(tilt) * math.tan(angle) - math.sin(tilt))


class DevelopmentRanges(Model):
    """The ranges of a sensor's and its electronics' settings; `farm.scene.camera.Development` explains each.

    Attributes:
        share: share of the pictures that are developed like this; the others have Blender's Filmic view transform.
        light_floor_share: share of the pictures of light floors (see `farm.spec.header`) that are exposed more. A meter
            makes a white table grey: a photographer corrects that, and an automatic camera does not.
        light_floor_ev: further exposure of those pictures, in stops.
        white_balance_ev: error of red and of blue, in stops.
        noise_share: share of the pictures with noise.
        full_well: electrons of a white pixel, sampled log-uniformly.
        jpeg_share: share of the pictures that are compressed.
    """

    share: Fraction = 0.0
    key: Annotated[tuple[Key, Key], AfterValidator(in_order)] = (0.15, 0.38)
    exposure_ev: StopsRange = (-2.0, 1.6)
    light_floor_share: Fraction = 0.5
    light_floor_ev: StopsRange = (0.2, 1.4)
    contrast: PositiveRange = (0.95, 1.75)
    saturation: NotNegativeRange = (0.7, 1.2)
    white_balance_ev: StopsRange = (-0.25, 0.25)
    vignetting: FractionRange = (0.0, 0.35)
    chromatic_aberration: Annotated[tuple[Aberration, Aberration], AfterValidator(in_order)] = (0.0, 0.002)
    noise_share: Fraction = 0.7
    full_well: PositiveRange = (800.0, 20_000.0)
    read_noise: NotNegativeRange = (1.0, 6.0)
    sharpening: NotNegativeRange = (0.0, 1.0)
    jpeg_share: Fraction = 0.6
    jpeg_quality: JpegQualityRange = (50, 97)

    @property
    def most_ev(self) -> float:
        """Largest exposure error of any picture, in stops: the two ranges do not add up beyond the larger upper end."""
        return max(self.exposure_ev[1], self.light_floor_ev[1])
