"""The base of every model that goes on the wire or on disk: frozen, closed, strict."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Sha256 = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
Vector2 = tuple[float, float]
Vector3 = tuple[float, float, float]


class Model(BaseModel):
    """Immutable, refuses unknown keys, silent type changes, NaN and infinities."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


Rgb = tuple[
    Annotated[int, Field(ge=0, le=255)],
    Annotated[int, Field(ge=0, le=255)],
    Annotated[int, Field(ge=0, le=255)],
]


Share = Annotated[float, Field(ge=0, le=1)]


Metres = Annotated[float, Field(gt=0)]
