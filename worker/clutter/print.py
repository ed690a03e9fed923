"""The images of a sheet (colour, roughness, relief, coverage) and the tools to draw them. Numpy, OpenCV, Pillow."""

from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from worker.noise import Field

TEXEL_M = 0.15e-3
"""Edge of a texel on the floor, in metres."""

Levels = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Print:
    """The images of a sheet. Columns run along the sheet; the top row is at its left side.

    Attributes:
        colour: (H, W, 3) sRGB levels.
        roughness: (H, W), 0 to 255 for a roughness of 0 to 1.
        alpha: (H, W), 0 to 255 for a coverage of 0 to 1; None covers everything.
        normal: (H, W, 3) levels of a normal map in OpenGL's convention; None is flat.
        metallic: 0 to 1.
        specular: weight of the surface's reflection: 0.5 for most surfaces, 0 for holes.
        margin_m: distance by which the images reach over the sheet's edge on all sides, in metres.
    """

    colour: Levels
    roughness: Levels
    alpha: Levels | None = None
    normal: Levels | None = None
    metallic: float = 0.0
    specular: float = 0.5
    margin_m: float = 0.0


def pixels_of(length_m: float, texel_m: float = TEXEL_M) -> int:
    """Count the texels that a length takes, at least 4.

    Args:
        length_m: length in metres.
        texel_m: edge of a texel, in metres.
    """
    return max(4, round(length_m / texel_m))


def levels(colour: NDArray[Any]) -> Levels:
    """Round numbers from 0 to 255 to 8 bits, clipped; the shape stays."""
    # Half a level is added in place of rounding, which costs more.
    rounded: Levels = np.clip(colour + 0.5, 0, 255).astype(np.uint8)
    return rounded


def plain(rows: int, columns: int, colour: tuple[int, int, int]) -> Field:
    """Make a canvas (rows, columns, 3) of one colour, 0 to 255."""
    return np.broadcast_to(np.array(colour, np.float32), (rows, columns, 3)).copy()


def ink(canvas: Field, cover: Field, colour: tuple[int, int, int]) -> None:
    """Lay ink over a canvas, in place.

    Args:
        canvas: (H, W, 3), 0 to 255.
        cover: (H, W), share of each pixel that the ink covers, 0 to 1.
        colour: sRGB levels of the ink.
    """
    inked = cover > 0
    under = canvas[inked]
    canvas[inked] = under + cover[inked][:, None] * (np.array(colour, np.float32) - under)


def relief(height_texels: Field) -> Levels:
    """Make the normal map (H, W, 3) of heights (H, W) in texels, in OpenGL's convention."""
    across = cv2.Sobel(height_texels, cv2.CV_32F, 1, 0, scale=1 / 8)
    down = cv2.Sobel(height_texels, cv2.CV_32F, 0, 1, scale=1 / 8)
    scale = np.float32(127.5) / np.sqrt(1 + across * across + down * down)
    normal = np.empty((*height_texels.shape, 3), np.uint8)
    for channel, slope in enumerate((-across, down, np.ones_like(across))):
        normal[:, :, channel] = 128 + slope * scale
    return normal


def bars(columns: int, centres: NDArray[np.float64], widths: NDArray[np.float64]) -> Field:
    """Compute the share of each pixel in a row that bars cover, exact wherever their edges are.

    Args:
        columns: number of pixels.
        centres: (N,), middle of each bar, in pixels from the row's beginning.
        widths: (N,), width of each bar, in pixels.

    Returns:
        (columns,), 0 to 1.
    """
    edge = np.arange(columns + 1, dtype=np.float64)
    low, high = centres - widths / 2, centres + widths / 2
    reached = np.clip(edge[:, None], low, high) - low
    covered: Field = np.clip(np.diff(reached, axis=0).sum(axis=1), 0, 1).astype(np.float32)
    return covered


def write(cover: Field, text: str, place: tuple[float, float], size_px: float, anchor: str = "ls") -> None:
    """Write a line of text into a coverage, in place, in the typeface that comes with Pillow.

    Args:
        cover: (H, W), 0 to 1.
        text: line of text.
        place: column and row of the anchor, by default the left end of the baseline.
        size_px: size of the type, in pixels; digits are about 0.7 of it high.
        anchor: anchor as Pillow names it.
    """
    face = ImageFont.load_default(size=size_px)
    left, top, right, bottom = (
        int(np.floor(edge + offset)) + sign * 2
        for edge, offset, sign in zip(
            face.getbbox(text, anchor=anchor), (place[0], place[1]) * 2, (-1, -1, 1, 1), strict=True
        )
    )
    row, column = max(top, 0), max(left, 0)
    rows, columns = min(bottom, cover.shape[0]) - row, min(right, cover.shape[1]) - column
    if rows <= 0 or columns <= 0:
        return
    image = Image.new("L", (columns, rows))
    ImageDraw.Draw(image).text((place[0] - column, place[1] - row), text, fill=255, font=face, anchor=anchor)
    part = cover[row : row + rows, column : column + columns]
    np.maximum(part, np.asarray(image, np.float32) / np.float32(255), out=part)


def lines(cover: Field, points: NDArray[np.float64], width_px: float, *, closed: bool = False) -> None:
    """Draw a polyline into a coverage, in place.

    Args:
        cover: (H, W), 0 to 1.
        points: (N, 2), columns and rows of the corners.
        width_px: width in pixels; a line narrower than a pixel is a pixel wide and paler.
        closed: whether the last corner is joined to the first.
    """
    drawn = np.zeros(cover.shape, np.uint8)
    place = np.rint(points * 16).astype(np.int32)
    strength = 255 if width_px >= 1 else max(40, round(255 * width_px))
    cv2.polylines(drawn, [place], closed, (strength,), max(1, round(width_px)), cv2.LINE_AA, 4)
    np.maximum(cover, drawn.astype(np.float32) / np.float32(255), out=cover)


def on_floor(drawn: Print, reach_m: float, depth: float) -> Print:
    """Add the thin shade that a sheet's edge throws all round; without it, the sheet seems painted on the floor.

    Args:
        drawn: sheet without a margin.
        reach_m: width of the shade, in metres.
        depth: share of the light that is missing right beside the edge.

    Returns:
        The sheet with a margin as wide as the shade.
    """
    pad = max(2, round(reach_m / TEXEL_M))
    rows, columns = drawn.roughness.shape
    alpha = np.pad(np.full((rows, columns), 255, np.uint8) if drawn.alpha is None else drawn.alpha, pad)
    away = cv2.distanceTransform((alpha < 128).astype(np.uint8), cv2.DIST_L2, 5)
    shade = np.float32(depth) * np.square(np.clip(1 - away / np.float32(pad), 0, 1))
    colour = np.pad(drawn.colour, ((pad, pad), (pad, pad), (0, 0)))
    thin = alpha < 255
    own = alpha[thin].astype(np.float32) / 255
    # Sheet and shade share one alpha: the sheet's part has its colour, and the shade's part is black.
    both = own + (1 - own) * shade[thin]
    colour[thin] = levels(colour[thin] * (own / np.maximum(both, 1e-3))[:, None])
    alpha[thin] = levels(255 * both)
    normal = drawn.normal
    if normal is not None:
        flat = np.full((*alpha.shape, 3), (128, 128, 255), np.uint8)
        flat[pad : pad + rows, pad : pad + columns] = normal
        normal = flat
    roughness = np.pad(drawn.roughness, pad, mode="edge")
    return replace(drawn, colour=colour, roughness=roughness, alpha=alpha, normal=normal, margin_m=pad * TEXEL_M)
