"""Things on laboratory benches: glassware, bottles, instruments."""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.goods import bottle, canister, mug, papers, small_carton
from blend.environments.layout import Piece
from blend.environments.palette import (
    BLACK,
    BLUE,
    DARK_GREY,
    GREY,
    LIGHT_GREY,
    PLASTICS,
    STEEL,
    WHITE,
    palette,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.solids import hanging
from blend.environments.tools import meter, parts_tray

Rng = np.random.Generator

LIQUIDS = palette("7a3a10 a86018 2a6a8a b0a040 8a2a2a 3a7a4a d0c8a8 402010")
"""Colours of the liquids in flasks and tubes."""


def flask(a: Assembly, rng: Rng) -> None:
    """A conical flask, partly full."""
    tint, r, h = pick(rng, LIQUIDS), rng.uniform(0.035, 0.06), rng.uniform(0.1, 0.18)
    a.lathe((0, 0.07, 0.002), [(r * 0.94, 0), (r * 0.7, 0.45 * h)], "dark glass", tint, sides=14)
    a.lathe((0, 0.07, 0), [(r, 0), (0.28 * r, 0.75 * h), (0.28 * r, h)], "glass", (0.86, 0.92, 0.92), sides=14)


def brown_bottle(a: Assembly, rng: Rng) -> None:
    """A reagent bottle with a label and a coloured cap."""
    r, h = rng.uniform(0.035, 0.055), rng.uniform(0.15, 0.24)
    brown = rng.random() < 0.6
    tint = (0.1, 0.03, 0.008) if brown else vary(rng, (0.7, 0.75, 0.75))
    a.lathe(
        (0, 0.07, 0), [(r, 0), (r, 0.66 * h), (0.45 * r, 0.8 * h), (0.45 * r, 0.9 * h)], "dark glass", tint, sides=14
    )
    a.cylinder((0, 0.07, 0.88 * h), 0.52 * r, 0.12 * h, "plastic", pick(rng, PLASTICS), sides=12)
    a.cylinder((0, 0.07, 0.18 * h), r * 1.01, 0.34 * h, "card", vary(rng, WHITE), sides=14)


def rack(a: Assembly, rng: Rng) -> None:
    """A rack of test tubes."""
    tint = pick(rng, PLASTICS)
    for z in (0.0, 0.06):
        a.box((0, 0.06, z), (0.26, 0.1, 0.008), "plastic", tint)
    for x in (-0.128, 0.128):
        a.box((x, 0.06, 0), (0.006, 0.1, 0.07), "plastic", tint)
    for x in np.linspace(-0.11, 0.11, 7):
        for y in (0.035, 0.085):
            a.cylinder((float(x), y, 0.005), 0.009, 0.11, "dark glass", pick(rng, LIQUIDS), sides=8)
            a.cylinder((float(x), y, 0.115), 0.01, 0.015, "plastic", pick(rng, PLASTICS), sides=8)


def instrument(a: Assembly, rng: Rng) -> None:
    """A bench instrument with a screen, knobs and sockets."""
    width, high, tint = (
        rng.uniform(0.32, 0.46),
        rng.uniform(0.16, 0.3),
        vary(rng, pick(rng, (WHITE, LIGHT_GREY, GREY, DARK_GREY))),
    )
    a.box((0, 0.2, 0.012), (width, 0.36, high), "paint", tint, bevel=0.012)
    a.box((0, 0.384, 0.025), (width - 0.02, 0.01, high - 0.025), "plastic", vary(rng, DARK_GREY), bevel=0.004)
    tone = rng.uniform(0.8, 1.5)
    shown = any_of(rng, PrintKind.SCREEN)
    a.picture((0.16 * width, 0.39, 0.28 * high), (0.5 * width, 0.6 * high), shown, "screen", (tone, tone, tone))
    for n in range(4):
        x, z = -0.22 * width - 0.09 * (n % 2), 0.35 * high + 0.35 * high * (n // 2)
        a.cylinder((x, 0.386, z), 0.016, 0.018, "plastic", pick(rng, (BLACK, GREY, WHITE)), axis="y", sides=12)
    for n in range(4):
        x = (-0.06 + 0.09 * n) * width / 0.4
        a.cylinder((x, 0.386, 0.12 * high + 0.012), 0.009, 0.012, "metal", STEEL, axis="y", sides=8)
        if rng.random() < 0.4:
            end = (x + rng.uniform(-0.25, 0.25), 0.5, 0.01)
            a.tube(hanging((x, 0.4, 0.12 * high + 0.012), end, 0.03), 0.004, "rubber", pick(rng, PLASTICS))


def stacked_instruments(a: Assembly, rng: Rng) -> None:
    """Two bench instruments, one on the other."""
    instrument(a, rng)
    with a.at(0, 0, 0.31):
        instrument(a, rng)


def microscope(a: Assembly, rng: Rng) -> None:
    """A microscope."""
    tint = vary(rng, pick(rng, (WHITE, LIGHT_GREY, DARK_GREY)))
    a.box((0, 0.14, 0), (0.18, 0.25, 0.05), "plastic", tint, bevel=0.015)
    a.box((0, 0.05, 0.05), (0.07, 0.06, 0.28), "plastic", tint, bevel=0.015)
    a.box((0, 0.16, 0.14), (0.15, 0.14, 0.015), "metal", DARK_GREY)
    a.box((0, 0.12, 0.29), (0.08, 0.2, 0.07), "plastic", tint, bevel=0.02)
    a.cylinder((0, 0.17, 0.18), 0.02, 0.12, "metal", STEEL, top=0.035)
    for x in (-0.03, 0.03):
        a.tube([(x, 0.18, 0.35), (x, 0.28, 0.42)], 0.017, "plastic", BLACK)
    a.cylinder((-0.12, 0.07, 0.12), 0.03, 0.24, "plastic", BLACK, axis="x")


def centrifuge(a: Assembly, rng: Rng) -> None:
    """A centrifuge: a squat device with a round lid."""
    tint = vary(rng, pick(rng, (WHITE, LIGHT_GREY, BLUE)))
    a.box((0, 0.22, 0), (0.38, 0.42, 0.22), "plastic", tint, bevel=0.03)
    a.cylinder((0, 0.2, 0.22), 0.16, 0.05, "plastic", vary(rng, GREY), sides=24)
    a.picture((0, 0.432, 0.06), (0.24, 0.1), any_of(rng, PrintKind.PANEL))


BENCH_TOP = (
    Piece(flask, 0.13, 0.13),
    Piece(flask, 0.13, 0.13),
    Piece(brown_bottle, 0.12, 0.13),
    Piece(brown_bottle, 0.12, 0.13),
    Piece(rack, 0.28, 0.14),
    Piece(instrument, 0.5, 0.45),
    Piece(stacked_instruments, 0.5, 0.45),
    Piece(microscope, 0.26, 0.3),
    Piece(centrifuge, 0.42, 0.46),
    Piece(meter, 0.2, 0.26),
    Piece(papers, 0.26, 0.34),
    Piece(parts_tray, 0.32, 0.25),
    Piece(mug, 0.1, 0.1),
    Piece(small_carton, 0.26, 0.24),
)
"""Things on top of laboratory benches; one that is listed twice is twice as likely."""

SHELF = (
    Piece(brown_bottle, 0.12, 0.13),
    Piece(brown_bottle, 0.12, 0.13),
    Piece(flask, 0.13, 0.13),
    Piece(small_carton, 0.26, 0.24),
    Piece(bottle, 0.1, 0.1),
    Piece(rack, 0.28, 0.14),
    Piece(canister, 0.27, 0.25),
)
"""Things on the shelves over laboratory benches; one that is listed twice is twice as likely."""
