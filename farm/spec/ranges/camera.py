"""The ranges of the camera, its lens and its sensor. The published lens is ideal, and Blender stands for the sensor."""

import math
from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

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
    in_order,
)

FNumber = Annotated[float, Field(ge=0.5, le=128)]
FocalLength = Annotated[float, Field(ge=10, le=500)]
Angle = Annotated[float, Field(ge=0, le=30)]
Distortion = Annotated[float, Field(ge=-0.2, le=0.2)]
FocusOffset = Annotated[float, Field(ge=-1, le=0.9)]
Key = Annotated[float, Field(gt=0, le=1)]
Aberration = Annotated[float, Field(ge=-0.05, le=0.05)]


class CameraRanges(Model):
    """The camera's heights, which set the cable's size in pixels; f-number, lens and tilt are ours.

    Above 1.5 m a picture would show the edge of the floor. The heights are those of a 50 mm lens: another one stands as
    much nearer or farther as keeps the picture's width. One of `focal_lengths_mm` is drawn.

    Attributes:
        tilt_deg: between the camera's view and straight down.
        roll_deg: about its view.
        focus_offset_share: how much nearer than the floor the focus is, as a share of the distance.
        distortion: radial, at the picture's corner; negative is a barrel.
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
    f_number: Annotated[tuple[FNumber, FNumber], AfterValidator(in_order)] = (8.0, 8.0)
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
    """How far from the middle of the floor a corner of the picture may be; inf at the horizon and above."""
    distance_m, tilt = height_m * focal_length_mm / FOCAL_LENGTH_MM, math.radians(tilt_deg)
    angle = tilt + math.atan(math.sqrt(0.5) * SENSOR_MM / focal_length_mm)
    if angle >= 0.5 * math.pi:
        return math.inf
    return distance_m * (math.cos(tilt) * math.tan(angle) - math.sin(tilt))


class DevelopmentRanges(Model):
    """What a camera's sensor and electronics do; see `farm.scene.camera.Development` for each.

    Attributes:
        share: of the pictures that are developed so; the others have Blender's Filmic view.
        light_floor_share: share of the pictures of light floors (`farm.spec.header`) that are exposed more. A meter
            that makes all grey makes a white table grey: a photographer opens up, and an automatic camera does not.
        light_floor_ev: by how much more.
        white_balance_ev: error of red and of blue, in stops.
        noise_share: of the pictures with noise at all.
        full_well: electrons, drawn evenly in its logarithm.
        jpeg_share: of the pictures that were compressed.
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
        """The most that any picture is overexposed: the larger upper end, as the two do not add up beyond it."""
        return max(self.exposure_ev[1], self.light_floor_ev[1])
