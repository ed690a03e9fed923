"""The width and height of a picture in pixels, and the one way in which people and files write them."""

import re
from collections.abc import Mapping
from typing import Final, Self

from pydantic import ModelWrapValidatorHandler, model_serializer, model_validator

from farm.model import Model

LEAST_EDGE_PX: Final = 32
"""Least pixels of an edge: in a smaller picture a cable is hardly a pixel wide."""

MOST_EDGE_PX: Final = 8192
"""Most pixels of an edge: a square of that edge takes several gigabytes while it is developed."""

MOST_ASPECT: Final = 4
"""Greatest ratio of the edges. The shorter edge sees that much less of the floor, and in a narrower strip the thickest
cables of a style fill it from side to side."""

_TEXT = re.compile(r"([0-9]{1,6})x([0-9]{1,6})", re.ASCII)


class PictureSize(Model):
    """The size of a picture. A file holds a square as the number of pixels of its edge, others as "WIDTHxHEIGHT".

    Validation takes these two, and a list of width and height.

    Attributes:
        width: number of columns.
        height: number of rows.
    """

    width: int
    height: int

    @classmethod
    def square(cls, edge: int) -> Self:
        """Make the size of a square picture.

        Args:
            edge: pixels along an edge.
        """
        return cls(width=edge, height=edge)

    @classmethod
    def of_array(cls, shape: tuple[int, ...]) -> Self:
        """Make the size of a picture from its array's shape: rows, columns, and any more."""
        return cls(width=shape[1], height=shape[0])

    @model_validator(mode="wrap")
    @classmethod
    def _read(cls, value: object, handler: ModelWrapValidatorHandler[Self]) -> Self:
        if isinstance(value, cls):
            return value
        edges = _edges_of(value)
        if edges is None:
            raise ValueError(
                "expected pixels: a whole number, such as 512, for a square, or WIDTHxHEIGHT, such as 640x480, "
                f"not {_short(repr(value))}"
            )
        return handler({"width": edges[0], "height": edges[1]})

    @model_serializer
    def _write(self) -> int | str:
        return self.width if self.width == self.height else str(self)

    def __str__(self) -> str:
        """The size as people and files write it."""
        return str(self.width) if self.width == self.height else f"{self.width}x{self.height}"

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and columns, as of an array."""
        return self.height, self.width

    @property
    def longer(self) -> int:
        """Pixels of the longer edge, which sees the sensor's whole width."""
        return max(self.width, self.height)

    @property
    def shorter(self) -> int:
        """Pixels of the shorter edge."""
        return min(self.width, self.height)

    @property
    def shares(self) -> tuple[float, float]:
        """Width and height, each as a share of the longer edge, above 0 and up to 1."""
        return self.width / self.longer, self.height / self.longer


def can_be_made(size: PictureSize) -> PictureSize:
    """Check that a dataset may have pictures of a size; return it.

    Raises:
        ValueError: if an edge or the ratio of the edges is beyond its limits.
    """
    if not (size.shorter >= LEAST_EDGE_PX and size.longer <= MOST_EDGE_PX):
        raise ValueError(f"expected edges from {LEAST_EDGE_PX} to {MOST_EDGE_PX} pixels, not {_short(size)}")
    if size.longer > MOST_ASPECT * size.shorter:
        raise ValueError(f"expected a longer edge of at most {MOST_ASPECT} times the shorter one, not {size}")
    return size


def read_resolution(text: str) -> int | str:
    """Read a flag's value: a whole number, else a text. The spec checks either."""
    try:
        return int(text)
    except ValueError:
        return text


def _edges_of(value: object) -> tuple[int, int] | None:
    """Width and height as a description gives them, of any size; None if it gives none."""
    match value:
        case bool():
            return None
        case int():
            return value, value
        case str():
            found = _TEXT.fullmatch(value)
            return None if found is None else (int(found[1]), int(found[2]))
        case Mapping():
            return _edges_of([value.get("width"), value.get("height")]) if len(value) == 2 else None
        case [int() as width, int() as height] if not isinstance(width, bool) and not isinstance(height, bool):
            return width, height
    return None


def _short(value: object) -> str:
    text = str(value)
    return text if len(text) <= 40 else f"{text[:37]}..."
