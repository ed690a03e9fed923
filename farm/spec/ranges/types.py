"""The types of random parameters' ranges: a low and a high end, each within the limits of its kind of value."""

from typing import Annotated

from pydantic import AfterValidator, BeforeValidator, Field


def in_order(bounds: tuple[float, float]) -> tuple[float, float]:
    """Check that the low end of a range is not above its high end.

    Args:
        bounds: low and high end.

    Returns:
        The range itself.

    Raises:
        ValueError: if the low end is above the high end.
    """
    if bounds[0] > bounds[1]:
        raise ValueError(f"the low end {bounds[0]} is above the high end {bounds[1]}")
    return bounds


def _counts_in_order(bounds: tuple[int, int]) -> tuple[int, int]:
    in_order(bounds)
    return bounds


def both_ends(value: object) -> object:
    """Turn one number into a range without width: earlier releases wrote some ranges as a number."""
    return (value, value) if isinstance(value, int | float) and not isinstance(value, bool) else value


Fraction = Annotated[float, Field(ge=0, le=1)]
Length = Annotated[float, Field(ge=-10, le=10)]
Positive = Annotated[float, Field(gt=0, le=1e5)]
NotNegative = Annotated[float, Field(ge=0, le=1e5)]
Level = Annotated[int, Field(ge=0, le=255)]
Modulus = Annotated[float, Field(ge=1e5, le=1e10)]
Density = Annotated[float, Field(ge=100, le=20_000)]
FrictionCoefficient = Annotated[float, Field(ge=0, le=2)]
CableCount = Annotated[int, Field(ge=1, le=24)]
"""Number of cables of a picture. A third of the wide style's scenes of 24 cables are drawn again, since cables cut into
each other or pass through; of scenes of 32 it is more than half, and piles reach half-way up to the camera."""

Bend = Annotated[float, Field(ge=-60, le=60)]
Diameter = Annotated[float, Field(ge=0.0005, le=0.02)]
CableLength = Annotated[float, Field(ge=0.05, le=2.0)]
Heights = Annotated[float, Field(ge=0.02, le=1.5)]
Count = Annotated[int, Field(ge=0, le=20)]
LampCount = Annotated[int, Field(ge=1, le=20)]
StripeCount = Annotated[int, Field(ge=1, le=4)]
StrandCount = Annotated[int, Field(ge=2, le=7)]
Stops = Annotated[float, Field(ge=-10, le=10)]
Temperature = Annotated[float, Field(ge=1000, le=20_000)]
Elevation = Annotated[float, Field(gt=0, le=90)]
Scale = Annotated[float, Field(ge=0.1, le=10)]
Zoom = Annotated[float, Field(ge=0.3, le=1)]
JpegQuality = Annotated[int, Field(ge=1, le=100)]

Range = Annotated[tuple[float, float], AfterValidator(in_order)]
FractionRange = Annotated[tuple[Fraction, Fraction], AfterValidator(in_order)]
LengthRange = Annotated[tuple[Length, Length], AfterValidator(in_order)]
PositiveRange = Annotated[tuple[Positive, Positive], AfterValidator(in_order)]
NotNegativeRange = Annotated[tuple[NotNegative, NotNegative], AfterValidator(in_order)]
ModulusRange = Annotated[tuple[Modulus, Modulus], AfterValidator(in_order)]
DensityRange = Annotated[tuple[Density, Density], AfterValidator(in_order)]
FrictionRange = Annotated[tuple[FrictionCoefficient, FrictionCoefficient], AfterValidator(in_order)]
LevelRange = Annotated[tuple[Level, Level], AfterValidator(_counts_in_order)]
CableCountRange = Annotated[tuple[CableCount, CableCount], AfterValidator(_counts_in_order)]
CountRange = Annotated[tuple[Count, Count], AfterValidator(_counts_in_order)]
LampCountRange = Annotated[tuple[LampCount, LampCount], AfterValidator(_counts_in_order)]
StripeCountRange = Annotated[tuple[StripeCount, StripeCount], AfterValidator(_counts_in_order)]
StrandCountRange = Annotated[tuple[StrandCount, StrandCount], AfterValidator(_counts_in_order)]
StopsRange = Annotated[tuple[Stops, Stops], AfterValidator(in_order)]
JpegQualityRange = Annotated[tuple[JpegQuality, JpegQuality], AfterValidator(_counts_in_order)]
# With a BeforeValidator, pydantic takes JSON's lists for tuples only if the field is not strict.
DiameterRange = Annotated[
    tuple[Diameter, Diameter], Field(strict=False), BeforeValidator(both_ends), AfterValidator(in_order)
]
CableLengthRange = Annotated[
    tuple[CableLength, CableLength], Field(strict=False), BeforeValidator(both_ends), AfterValidator(in_order)
]
BendRange = Annotated[tuple[Bend, Bend], AfterValidator(in_order)]
TemperatureRange = Annotated[tuple[Temperature, Temperature], AfterValidator(in_order)]
ElevationRange = Annotated[tuple[Elevation, Elevation], AfterValidator(in_order)]
ZoomRange = Annotated[tuple[Zoom, Zoom], AfterValidator(in_order)]
ScaleRange = Annotated[tuple[Scale, Scale], AfterValidator(in_order)]
