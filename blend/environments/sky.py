"""Draw the panorama of a sky with clouds over a blurred town, in numpy."""

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.noise import fractal

WIDTH_PX = 2048
"""Width of the panorama, pixels: 0.18 degrees each, enough for a blurred sky."""

_CLEAR_ZENITH, _CLEAR_HORIZON = np.array([70, 118, 190]), np.array([196, 214, 230])
_GREY_ZENITH, _GREY_HORIZON = np.array([196, 200, 206]), np.array([226, 229, 230])
_WALLS = ((150, 128, 110), (172, 160, 144), (128, 116, 108), (186, 182, 172), (140, 92, 74), (110, 116, 122))


def draw_sky(rng: np.random.Generator, overcast: float, *, town: bool) -> NDArray[np.uint8]:
    """Draw a panorama (1024, 2048, 3), sRGB, the zenith first.

    Args:
        rng: source of the randomness, for the clouds and the houses.
        overcast: cover by clouds, from 0 for a blue sky to 1 for a grey one.
        town: whether houses and trees stand on the horizon.
    """
    rows, columns = WIDTH_PX // 2, WIDTH_PX
    height = np.linspace(1, 0, rows // 2)[:, None, None] ** 0.6
    zenith = _CLEAR_ZENITH * (1 - overcast) + _GREY_ZENITH * overcast
    horizon = _CLEAR_HORIZON * (1 - overcast) + _GREY_HORIZON * overcast
    above = np.broadcast_to(zenith * height + horizon * (1 - height), (rows // 2, columns, 3)).copy()
    noise = fractal(rng, Grid(pixels=512, size_mm=512.0), 150.0, 4.0)
    stretched = cv2.resize(noise, (columns, rows // 2), interpolation=cv2.INTER_CUBIC)
    cover = np.clip((stretched - 0.5 + overcast) * 0.6, 0, 1)[..., None] * np.clip(height * 3, 0, 1)
    above = above * (1 - 0.85 * cover) + np.array([238, 239, 240]) * 0.85 * cover
    below = np.broadcast_to(np.array([104, 100, 92]), (rows // 2, columns, 3))
    sky = np.ascontiguousarray(np.concatenate([above, below]).clip(0, 255).astype(np.uint8))
    if town:
        _houses(sky, rng)
    return cv2.GaussianBlur(sky, (0, 0), 1.2).astype(np.uint8)


def _houses(sky: NDArray[np.uint8], rng: np.random.Generator) -> None:
    """Draw house fronts with windows on the horizon, and round trees in front of them."""
    horizon, x = sky.shape[0] // 2, 0
    while x < sky.shape[1]:
        width, high = int(rng.integers(50, 170)), int(rng.integers(18, 120))
        if rng.random() < 0.8:
            shade = rng.uniform(0.65, 1.05)
            red, green, blue = (int(value * shade) for value in _WALLS[int(rng.integers(len(_WALLS)))])
            cv2.rectangle(sky, (x, horizon - high), (x + width, horizon + 12), (red, green, blue), -1)
            cv2.rectangle(sky, (x, horizon - high), (x + width, horizon - high + 4), (90, 84, 80), -1)
            for wx in range(x + 7, x + width - 10, 15):
                for wy in range(horizon - high + 10, horizon, 17):
                    tone = int(rng.integers(50, 120))
                    cv2.rectangle(sky, (wx, wy), (wx + 7, wy + 9), (tone, tone + 8, tone + 16), -1)
        x += width + int(rng.integers(0, 40))
    for _ in range(70):
        place, size = (int(rng.integers(sky.shape[1])), horizon + int(rng.integers(-14, 6))), int(rng.integers(6, 20))
        green = int(rng.integers(34, 58))
        cv2.circle(sky, place, size, (green - 10, green, green - 20), -1, cv2.LINE_AA)
