"""A sheet of examples: eight pictures to a row, each example with its name beneath. Pillow."""

import io
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

EDGE_PX = 200
_PICTURES_A_ROW = 8
_GAP_PX = 3
_LABEL_PX = 18
_BETWEEN_PX = 14
_JPEG_QUALITY = 88


def examples_a_row(each: int) -> int:
    """How many examples of `each` pictures, at least 1, stand side by side."""
    return max(1, _PICTURES_A_ROW // each)


def draw_sheet(examples: Sequence[tuple[str, Sequence[NDArray[np.uint8]]]]) -> bytes:
    """Draw a JPEG.

    Args:
        examples: names and pictures (H, W, 3), equally many of each.
    """
    each = max(len(pictures) for _, pictures in examples)
    width = each * (EDGE_PX + _GAP_PX) + _BETWEEN_PX
    height = EDGE_PX + _LABEL_PX + _GAP_PX
    across = examples_a_row(each)
    sheet = Image.new("RGB", (across * width - _BETWEEN_PX, math.ceil(len(examples) / across) * height), "white")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(13)
    for number, (label, pictures) in enumerate(examples):
        left, top = number % across * width, number // across * height
        for column, picture in enumerate(pictures):
            small = Image.fromarray(picture).resize((EDGE_PX, EDGE_PX), Image.Resampling.LANCZOS)
            sheet.paste(small, (left + column * (EDGE_PX + _GAP_PX), top))
        pen.text((left + 2, top + EDGE_PX + 1), label, fill="black", font=font)
    encoded = io.BytesIO()
    sheet.save(encoded, "JPEG", quality=_JPEG_QUALITY)
    return encoded.getvalue()
