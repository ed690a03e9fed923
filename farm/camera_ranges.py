"""The ranges of the camera, its lens and its sensor. The published lens is ideal, and Blender stands for the sensor."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.lens import FOCAL_LENGTH_MM
from farm.model import Model
from farm.range_types import (
    Fraction,
    FractionRange,
    Heights,
    JpegQualityRange,
    NotNegativeRange,
    Positive,
    PositiveRange,
    Range,
    in_order,
)

FNumber = Annotated[float, Field(ge=0.5, le=128)]
Angle = Annotated[float, Field(ge=0, le=30)]
Distortion = Annotated[float, Field(ge=-0.2, le=0.2)]


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
    focal_lengths_mm: Annotated[tuple[Positive, ...], Field(min_length=1)] = (FOCAL_LENGTH_MM,)
    tilt_deg: Annotated[tuple[Angle, Angle], AfterValidator(in_order)] = (0.0, 0.0)
    roll_deg: Range = (0.0, 0.0)
    focus_offset_share: Range = (0.0, 0.0)
    distortion: Annotated[tuple[Distortion, Distortion], AfterValidator(in_order)] = (0.0, 0.0)


class DevelopmentRanges(Model):
    """What a camera's sensor and electronics do; see `farm.photograph.Development` for each.

    Attributes:
        share: of the pictures that are developed so; the others have Blender's Filmic view.
        white_balance_ev: error of red and of blue, in stops.
        noise_share: of the pictures with noise at all.
        full_well: electrons, drawn evenly in its logarithm.
        jpeg_share: of the pictures that were compressed.
    """

    share: Fraction = 0.0
    key: PositiveRange = (0.15, 0.38)
    exposure_ev: Range = (-1.5, 1.4)
    contrast: PositiveRange = (0.95, 1.6)
    saturation: NotNegativeRange = (0.7, 1.2)
    white_balance_ev: Range = (-0.25, 0.25)
    vignetting: FractionRange = (0.0, 0.35)
    chromatic_aberration: Range = (0.0, 0.002)
    noise_share: Fraction = 0.7
    full_well: PositiveRange = (800.0, 20_000.0)
    read_noise: NotNegativeRange = (1.0, 6.0)
    sharpening: NotNegativeRange = (0.0, 1.0)
    jpeg_share: Fraction = 0.6
    jpeg_quality: JpegQualityRange = (50, 97)
