"""Colours of the things in environments, in linear light, and random choices among them."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from assets.colour import light_of_srgb

Colour = tuple[float, float, float]
T = TypeVar("T")


def srgb(code: str) -> Colour:
    """Convert a colour such as "d08030" (sRGB, hexadecimal) to linear light, 0 to 1."""
    red, green, blue = (light_of_srgb(int(code[place : place + 2], 16) / 255.0) for place in (0, 2, 4))
    return red, green, blue


def palette(codes: str) -> tuple[Colour, ...]:
    """Read the colours of hexadecimal codes that blanks separate."""
    return tuple(srgb(code) for code in codes.split())


MACHINES = palette("3f6b57 2f5d7c 4a6d8c 8a9a96 c9c4b0 d9822b d8b020 6e7f80 9aa7a0 30475e b5452c e0dccb 5a7a5a")
STEEL_FURNITURE = palette("9da3a6 c5c8c6 6c7780 d8d9d4 4f5b66 7a8b8f 2d5f8b 35605a a7b0b5 b9a98c")
PLASTICS = palette("1f4e9c c0282a 2c7a3a e0b81c 222222 d9d9d6 5b5b5e e06a1c 2a8fa8 7a2a5a f0eee6 3c3c40")
BINS = palette("1d5fae c8281f e8b90f 2a8a45 3a3a3c 1d5fae c8281f 7d8488")
CARDBOARD = palette("b08a5a a67c4c bb9766 9a7448 c4a274 d8cfc0")
BOOKS = palette("2c4a7c 8c2c2c 3a6b45 c9a23a 222428 e6e2d6 6a4a7a b06030 4a8a94 909498 d8d8d0 1a1a1c f0f0ea 54708c")
CASES = palette("6f7368 4a4f4a 8a8678 2a2c2e 5a6650 9a9a94 3c4448")
FABRICS = palette("2c3440 4a5560 6a2c30 2c4a6a 3a5a4a 1c1c20 7a7468 8a5a30 404a70")
CAR_PAINT = palette("1a1c20 c8cacc 8a1c1c 1c3a6a e8e8e6 4a4e52 2a4a3a 8a8c8e 6a7480 9c7a50")
CABLES = palette("141414 141414 1a1a1a 8a8a8a d06a10 1c4ea0 b01818 2a7a30 d8c010 e6e6e6")
WOODS = palette("c8a070 a87c50 d8b88c 8a6040 b89468")

BLACK, WHITE = srgb("141414"), srgb("e8e8e4")
GREY, LIGHT_GREY, DARK_GREY = srgb("8a8c8c"), srgb("c4c6c4"), srgb("3c3f42")
STEEL, ALUMINIUM, BRASS, COPPER = srgb("a8a8a6"), srgb("d0d1d2"), srgb("c8a050"), srgb("c07048")
YELLOW, RED, ORANGE, BLUE, GREEN = srgb("e0b010"), srgb("b81c1c"), srgb("e0701c"), srgb("1c509c"), srgb("2a7a3c")


def pick(rng: np.random.Generator, choices: Sequence[T]) -> T:
    """Pick one of several choices, each equally likely."""
    return choices[int(rng.integers(len(choices)))]


def vary(rng: np.random.Generator, colour: Colour, spread: float = 0.12) -> Colour:
    """Make a colour brighter or darker by up to the share `spread`, and shift its hue by a third of that."""
    brightness = rng.uniform(1 - spread, 1 + spread)
    red, green, blue = (float(value * brightness * rng.uniform(1 - spread / 3, 1 + spread / 3)) for value in colour)
    return red, green, blue
