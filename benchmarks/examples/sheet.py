"""Draw a sheet of examples with Pillow: eight pictures in a row, and the name beneath each example."""

import io
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

EDGE_PX = 200
"""Edge of a picture on the sheet, pixels."""
_PICTURES_A_ROW = 8
"""Most pictures in a row, so that a sheet fits on a screen."""
_GAP_PX = 3
"""Gap between two pictures of an example, pixels."""
_LABEL_PX = 18
"""Height of the strip for an example's name, pixels."""
_BETWEEN_PX = 14
"""Gap between two examples, pixels: wider than within one, so that they read as groups."""
_JPEG_QUALITY = 88
"""Quality of the JPEG file, 0 to 100: high enough for fine textures."""


def examples_a_row(each: int) -> int:
    """Number of examples side by side in a row, at least 1, if each has `each` pictures."""
    return max(1, _PICTURES_A_ROW // each)


def draw_sheet(examples: Sequence[tuple[str, Sequence[NDArray[np.uint8]]]]) -> bytes:
    """Draw the sheet and return it as the content of a JPEG file.

    Args:
        examples: name and pictures, (H, W, 3), of each example; every example has the same number of pictures.
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
