"""The base class of every model that goes on the wire or on disk, and the types that many fields have."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Sha256 = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
"""A SHA-256 checksum in 64 hexadecimal digits, lower case."""

Vector2 = tuple[float, float]
Vector3 = tuple[float, float, float]


class Model(BaseModel):
    """An immutable model that refuses unknown keys, values of another type, NaN and infinities."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


Rgb = tuple[
    Annotated[int, Field(ge=0, le=255)],
    Annotated[int, Field(ge=0, le=255)],
    Annotated[int, Field(ge=0, le=255)],
]
"""Levels of red, green and blue, 0 to 255; each field says whether they are sRGB or linear."""

Share = Annotated[float, Field(ge=0, le=1)]
"""A part of a whole, 0 to 1."""

Metres = Annotated[float, Field(gt=0)]
"""A length in metres, above 0."""
