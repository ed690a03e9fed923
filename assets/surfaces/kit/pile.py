"""Loose things heaped on a floor: small pictures with a height, laid one upon another round the tile's edges."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import cv2
import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.colour import rgb
from assets.surfaces.kit.grid import Field, Grid

Block: TypeAlias = tuple[slice, slice] | tuple[npt.NDArray[np.intp], ...]
"""Index of a rectangle of texels: slices, or rows and columns where it wraps round the edge."""


@dataclass(frozen=True)
class Sprite:
    """One loose thing seen from above.

    Attributes:
        colour: Shape (h, w, 3), sRGB 0 to 1.
        height_mm: Height over what it rests on, shape (h, w).
        mask: 1 where the thing is, 0 where it isn't, shape (h, w).
    """

    colour: Field
    height_mm: Field
    mask: Field


class Pile:
    """A floor's colour and relief, on which sprites are laid.

    Attributes:
        colour: Shape (H, W, 3), sRGB 0 to 1.
        height_mm: Shape (H, W).
        thing: Number of the topmost sprite laid on each texel, -1 where the floor shows, shape (H, W).
    """

    def __init__(self, grid: Grid, colour: Field, height_mm: Field) -> None:
        self.grid = grid
        self.colour = np.array(colour, np.float32)
        self.height_mm = np.array(height_mm, np.float32)
        self.thing = np.full(height_mm.shape, -1, np.int32)
        self._laid = 0

    def lay(self, sprite: Sprite, x_mm: float, y_mm: float, tint: Field, sink: float = 0.5) -> None:
        """Lay a sprite on what is already there.

        Args:
            sprite: The thing.
            x_mm: Position of the sprite's centre to the right, millimetres.
            y_mm: Position of the sprite's centre downwards, millimetres.
            tint: Factors for the sprite's colour, shape (3,).
            sink: Level at which the sprite rests on the heights beneath it: 0 at the lowest, 1 on the highest.
        """
        high, wide = sprite.mask.shape
        top = round(y_mm / self.grid.texel_mm - high / 2)
        left = round(x_mm / self.grid.texel_mm - wide / 2)
        edge = self.grid.pixels
        if 0 <= top <= edge - high and 0 <= left <= edge - wide:
            where: Block = (slice(top, top + high), slice(left, left + wide))
        else:
            where = np.ix_(np.arange(top, top + high) % edge, np.arange(left, left + wide) % edge)
        beneath = self.height_mm[where]
        covered = beneath[::3, ::3][sprite.mask[::3, ::3] > 0.5]
        if covered.size == 0:
            return
        low, top_height = float(covered.min()), float(covered.max())
        raised = sprite.height_mm + np.float32(low + sink * (top_height - low))
        seen = np.where(raised > beneath, sprite.mask, np.float32(0.0))
        self.height_mm[where] = np.where(seen > 0.5, raised, beneath)
        below = self.colour[where]
        self.colour[where] = below + (sprite.colour * tint - below) * seen[..., None]
        self.thing[where] = np.where(seen > 0.5, self._laid, self.thing[where])
        self._laid += 1

    def strew(
        self,
        rng: np.random.Generator,
        sprites: Sequence[Sprite],
        count: int,
        *,
        brightness: float = 0.12,
        hue: float = 0.03,
        sink: float = 0.5,
    ) -> None:
        """Lay sprites, each chosen and placed at random, in turn.

        Args:
            rng: Source of the randomness.
            sprites: Sprites to choose from.
            count: Number of sprites to lay.
            brightness: Standard deviation of the sprites' relative brightness.
            hue: Standard deviation of the shift between warm and cool.
            sink: Level at which a sprite rests on the heights beneath it: 0 at the lowest, 1 on the highest.
        """
        for _ in range(count):
            x, y = rng.uniform(0, self.grid.size_mm, 2)
            light, warm = rng.standard_normal(2).clip(-2, 2) * (brightness, hue)
            tint = (1 + light) * (1 + warm * np.array([1.0, 0.0, -1.0]))
            sprite = sprites[int(rng.integers(len(sprites)))]
            self.lay(sprite, float(x), float(y), tint.astype(np.float32), sink)


def pebble(rng: np.random.Generator, grid: Grid, radius_mm: float, code: str, angular: float) -> Sprite:
    """Make a stone.

    Args:
        rng: Source of the randomness.
        grid: Grid that sets the size of a texel.
        radius_mm: Mean radius.
        code: Colour of the stone, hexadecimal.
        angular: Angularity, from 0 for a rounded river pebble to 1 for broken rock.

    Returns:
        The stone, lying at a random angle.
    """
    x, y, angle = local_frame(rng, grid, 1.6 * radius_mm)
    x, y = x / rng.uniform(0.95, 1.3), y / rng.uniform(0.7, 1.0)
    distance = np.sqrt(x * x + y * y)
    for cut in rng.uniform(0, 2 * np.pi, int(5 + 3 * angular)):
        flat = (x * np.cos(cut) + y * np.sin(cut)) / rng.uniform(0.55, 0.9)
        distance = np.maximum(distance, angular * flat + (1 - angular) * distance * 0.98)
    theta = np.arctan2(y, x)
    for wave in (2, 3, 5):
        distance = distance * (1 + 0.035 / wave * 2 * np.cos(wave * theta + angle * wave))
    t = distance / radius_mm
    dome = np.sqrt(np.clip(1 - np.power(t, 2.2 + 1.5 * angular), 0, 1))
    facet = sum(
        (np.abs(x * np.cos(a) + y * np.sin(a)) / radius_mm for a in rng.uniform(0, np.pi, 2)),
        start=np.zeros_like(x),
    )
    grainy = rng.normal(0, 1, x.shape)
    broad = smooth_noise(rng.normal(0, 1, x.shape), 0.25 * radius_mm / grid.texel_mm)
    fine = smooth_noise(grainy, 0.9)
    # A stone rests on its belly: its rim hangs above the ground and hides what lies beneath.
    height = radius_mm * (0.4 + 0.6 * dome - 0.10 * angular * facet + 0.025 * broad * dome)
    light = 1 + 0.06 * fine + 0.07 * broad - 0.22 * (1 - dome)
    mask = np.clip((1 - t) * radius_mm / grid.texel_mm + 0.5, 0, 1)
    colour = rgb(code) * light[..., None]
    return trimmed(Sprite(colour.astype(np.float32), height.astype(np.float32), mask.astype(np.float32)))


def trimmed(sprite: Sprite) -> Sprite:
    """Cut away the empty margin of a sprite."""
    rows, columns = np.flatnonzero(sprite.mask.any(axis=1)), np.flatnonzero(sprite.mask.any(axis=0))
    if rows.size == 0:
        return sprite
    block = (slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1))
    return Sprite(sprite.colour[block], sprite.height_mm[block], sprite.mask[block])


def local_frame(
    rng: np.random.Generator, grid: Grid, reach_mm: float, spread: float = np.pi
) -> tuple[Field, Field, float]:
    """Make the coordinates of a small thing lying at a random angle.

    Args:
        rng: Source of the randomness.
        grid: Grid that sets the size of a texel.
        reach_mm: Distance from the centre to the edges of the square that the coordinates cover.
        spread: Largest angle from the x axis in radians.

    Returns:
        Coordinates along and across the thing in millimetres, each of shape (n, n) with n odd, and the angle.
    """
    reach = max(2, int(np.ceil(reach_mm / grid.texel_mm)))
    axis = np.arange(-reach, reach + 1) * grid.texel_mm
    x, y = np.meshgrid(axis, axis)
    angle = float(rng.uniform(-spread, spread))
    along = x * np.cos(angle) + y * np.sin(angle)
    across = y * np.cos(angle) - x * np.sin(angle)
    return along.astype(np.float32), across.astype(np.float32), angle


def smooth_noise(noise: npt.NDArray[np.floating[Any]], sigma: float) -> Field:
    """Blur noise with a Gaussian of `sigma` texels and bring it back to standard deviation 1."""
    soft = np.asarray(cv2.GaussianBlur(noise.astype(np.float32), (0, 0), max(0.3, sigma)), np.float32)
    return soft / np.float32(max(float(soft.std()), 1e-6))
