"""Lamps: their shining parts have the material `glow`, whose tint is the radiance."""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.palette import ALUMINIUM, DARK_GREY, WHITE, Colour

COOL: Colour = (17.0, 18.5, 20.0)
"""Radiance of a bluish lamp in red, green and blue, linear: about three times that of the sky in a window."""
NEUTRAL: Colour = (20.0, 19.0, 17.0)
"""Radiance of a white lamp in red, green and blue, linear."""
WARM: Colour = (22.0, 17.5, 11.5)
"""Radiance of a yellowish lamp in red, green and blue, linear."""


def panel(a: Assembly, z: float, light: Colour = NEUTRAL, size: tuple[float, float] = (0.58, 0.58)) -> None:
    """A flat panel set in a ceiling at height z."""
    a.box((0, 0, z - 0.02), (size[0] + 0.05, size[1] + 0.05, 0.02), "paint", WHITE)
    a.box((0, 0, z - 0.025), (*size, 0.006), "glow", light)


def tube(a: Assembly, z: float, light: Colour = COOL, length: float = 1.5, drop: float = 0.0) -> None:
    """A long housing with one fluorescent tube, hung `drop` below height z."""
    low = z - drop - 0.09
    a.box((0, 0, low + 0.03), (length, 0.12, 0.06), "paint", WHITE, bevel=0.01)
    a.cylinder((-0.5 * length + 0.03, 0, low), 0.019, length - 0.06, "glow", light, axis="x", sides=8)
    for side in (-1, 1):
        a.box((side * (0.5 * length - 0.02), 0, low - 0.02), (0.03, 0.05, 0.06), "plastic", WHITE)
        if drop > 0.02:
            a.cylinder((side * 0.4 * length, 0, low + 0.09), 0.004, drop, "metal", DARK_GREY, sides=6)


def bell(a: Assembly, z: float, light: Colour = WARM, radius: float = 0.24, drop: float = 0.8) -> None:
    """A bell-shaped lamp for high halls, hung by a cable."""
    low = z - drop - radius
    profile = [
        (radius, 0.0),
        (radius * 0.85, radius * 0.35),
        (radius * 0.4, radius * 0.8),
        (radius * 0.3, radius * 1.1),
    ]
    a.lathe((0, 0, low), profile, "metal", ALUMINIUM)
    a.lathe((0, 0, low + 0.01), [(radius * 0.86, 0.0), (radius * 0.8, 0.02)], "glow", light)
    a.cylinder((0, 0, low + radius), 0.006, drop, "rubber", DARK_GREY, sides=6)


def globe(a: Assembly, z: float, light: Colour = WARM, radius: float = 0.16, drop: float = 0.5) -> None:
    """A round shade on a cord."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 9)
    profile = [(float(radius * np.cos(t)), float(radius * (1 + np.sin(t)))) for t in angle]
    low = z - drop - 2 * radius
    a.lathe((0, 0, low), profile, "glow", (light[0] * 0.3, light[1] * 0.3, light[2] * 0.3))
    a.cylinder((0, 0, low + 2 * radius), 0.004, drop, "rubber", DARK_GREY, sides=6)


def desk_lamp(a: Assembly, rng: np.random.Generator) -> None:
    """A jointed lamp on a foot."""
    tint = WHITE if rng.random() < 0.4 else DARK_GREY
    a.cylinder((0, 0.1, 0), 0.09, 0.02, "paint", tint)
    a.tube([(0, 0.1, 0.02), (0, 0.02, 0.28), (0, 0.06, 0.42), (0, 0.26, 0.5)], 0.009, "paint", tint)
    a.lathe((0, 0.28, 0.42), [(0.085, 0.0), (0.06, 0.06), (0.025, 0.1)], "paint", tint)
    a.cylinder((0, 0.28, 0.425), 0.05, 0.01, "glow", WARM)


def rows(xs: tuple[float, float, int], ys: tuple[float, float, int]) -> list[tuple[float, float]]:
    """List the places x, y of lamps in a grid; `xs` and `ys` each hold the first place, the last one and the count."""
    return [(float(x), float(y)) for x in np.linspace(*xs) for y in np.linspace(*ys)]
