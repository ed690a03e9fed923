"""What sheets are drawn on: an image of their colour, with roughness, relief and coverage. Numpy, OpenCV, Pillow."""

from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from worker.noise import Field

TEXEL_M = 0.15e-3

Levels = NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Print:
    """A sheet's maps, (H, W) each; columns run along the sheet, the top row is at its left side.

    Attributes:
        colour: (H, W, 3) sRGB levels.
        roughness: 0 to 255.
        alpha: 0 to 255, what of it there is; None: all.
        normal: (H, W, 3) levels of a normal map in OpenGL convention; None: flat.
        metallic: 0 to 1.
        specular: 0.5 for what has a surface, 0 for holes.
        margin_m: how far the images reach over the sheet's edge on all sides.
    """

    colour: Levels
    roughness: Levels
    alpha: Levels | None = None
    normal: Levels | None = None
    metallic: float = 0.0
    specular: float = 0.5
    margin_m: float = 0.0


def pixels_of(length_m: float, texel_m: float = TEXEL_M) -> int:
    """How many texels a length takes."""
    return max(4, round(length_m / texel_m))


def levels(colour: NDArray[Any]) -> Levels:
    """Floats from 0 to 255 as 8 bits."""
    # Half a level is added in place of rounding, which costs more.
    rounded: Levels = np.clip(colour + 0.5, 0, 255).astype(np.uint8)
    return rounded


def plain(rows: int, columns: int, colour: tuple[int, int, int]) -> Field:
    """A field (rows, columns, 3) of one colour, 0 to 255."""
    return np.broadcast_to(np.array(colour, np.float32), (rows, columns, 3)).copy()


def ink(canvas: Field, cover: Field, colour: tuple[int, int, int]) -> None:
    """Lay ink over a canvas (H, W, 3), in place, as much as `cover` (H, W), 0 to 1, says."""
    inked = cover > 0
    under = canvas[inked]
    canvas[inked] = under + cover[inked][:, None] * (np.array(colour, np.float32) - under)


def relief(height_texels: Field) -> Levels:
    """The normal map of heights (H, W), counted in texels."""
    across = cv2.Sobel(height_texels, cv2.CV_32F, 1, 0, scale=1 / 8)
    down = cv2.Sobel(height_texels, cv2.CV_32F, 0, 1, scale=1 / 8)
    scale = np.float32(127.5) / np.sqrt(1 + across * across + down * down)
    normal = np.empty((*height_texels.shape, 3), np.uint8)
    for channel, slope in enumerate((-across, down, np.ones_like(across))):
        normal[:, :, channel] = 128 + slope * scale
    return normal


def bars(columns: int, centres: NDArray[np.float64], widths: NDArray[np.float64]) -> Field:
    """How much of each of so many pixels bars cover, (columns,): exact, wherever their edges are."""
    edge = np.arange(columns + 1, dtype=np.float64)
    low, high = centres - widths / 2, centres + widths / 2
    reached = np.clip(edge[:, None], low, high) - low
    covered: Field = np.clip(np.diff(reached, axis=0).sum(axis=1), 0, 1).astype(np.float32)
    return covered


def write(cover: Field, text: str, place: tuple[float, float], size_px: float, anchor: str = "ls") -> None:
    """Write a line of text into a coverage (H, W), in place.

    Args:
        cover: 0 to 1.
        text: in the typeface that Pillow brings along.
        place: column and row of the anchor, by default the baseline's left end.
        size_px: of the type; digits are about 0.7 of it high.
        anchor: as Pillow names them.
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
    """Draw a polyline (N, 2), columns and rows, into a coverage (H, W), in place; at least a pixel wide."""
    drawn = np.zeros(cover.shape, np.uint8)
    place = np.rint(points * 16).astype(np.int32)
    strength = 255 if width_px >= 1 else max(40, round(255 * width_px))
    cv2.polylines(drawn, [place], closed, (strength,), max(1, round(width_px)), cv2.LINE_AA, 4)
    np.maximum(cover, drawn.astype(np.float32) / np.float32(255), out=cover)


def on_floor(drawn: Print, reach_m: float, depth: float) -> Print:
    """The same with the thin shade that its edge throws all round: without, it seems painted on the floor.

    Args:
        drawn: without a margin.
        reach_m: how far the shade is seen.
        depth: share of light that is missing right beside the edge.
    """
    pad = max(2, round(reach_m / TEXEL_M))
    rows, columns = drawn.roughness.shape
    alpha = np.pad(np.full((rows, columns), 255, np.uint8) if drawn.alpha is None else drawn.alpha, pad)
    away = cv2.distanceTransform((alpha < 128).astype(np.uint8), cv2.DIST_L2, 5)
    shade = np.float32(depth) * np.square(np.clip(1 - away / np.float32(pad), 0, 1))
    colour = np.pad(drawn.colour, ((pad, pad), (pad, pad), (0, 0)))
    thin = alpha < 255
    own = alpha[thin].astype(np.float32) / 255
    # Shade and sheet make one alpha: the sheet's share of it has its colour, and the shade's is black.
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
