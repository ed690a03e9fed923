"""The profile of each kind of stick, which is turned about its axis. Pure numpy.

The axis is x, from 0 to the stick's length. No part is farther from the axis than the radius of the rod that fell, but
for the rounded corners of a pencil.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from farm.scene.clutter import Stick, StickKind
from worker.clutter.solid import SIDES, Finish, Section, Solid, box, section

PENCIL_CORNER = 1.09
"""Distance of a pencil's rounded corners from its axis, over that of its flats; sharp corners would have 1.155."""

STEEL = Finish(colour=(190, 190, 192), roughness=0.28, metallic=1.0, mottle=0.15, grain_m=0.002, streaks=8.0)
DARK_STEEL = Finish(colour=(92, 92, 96), roughness=0.38, metallic=1.0, mottle=0.25, grain_m=0.002)
BRASS = Finish(colour=(214, 178, 102), roughness=0.25, metallic=1.0, mottle=0.15)
WOOD = Finish(colour=(214, 176, 128), roughness=0.75, mottle=0.3, grain_m=0.0012, streaks=10.0)
GRAPHITE = Finish(colour=(48, 48, 50), roughness=0.35, metallic=0.3)
RUBBER = Finish(colour=(28, 28, 30), roughness=0.7, mottle=0.2)


@dataclass(frozen=True, slots=True)
class Turned:
    """A stick before it is turned.

    Attributes:
        sections: sections from its start to its end.
        finishes: finishes that the sections number.
        extras: solids that are not round, within the outline of the sections.
        roll_deg: rotation about its axis, in degrees.
    """

    sections: tuple[Section, ...]
    finishes: tuple[Finish, ...]
    extras: tuple[Solid, ...] = ()
    roll_deg: float = 0.0


def _dome(start_m: float, end_m: float, radius_m: float, inner: float = 0.0) -> list[tuple[float, float]]:
    """Make the profile of a rounded end: from a share `inner` of the radius at `start_m` to all of it at `end_m`."""
    angle = np.linspace(0.0, np.pi / 2, 10)
    along = end_m + (start_m - end_m) * np.cos(angle)
    radius = radius_m * (inner + (1 - inner) * np.sin(angle))
    return list(zip(along.tolist(), radius.tolist(), strict=True))


def _darker(colour: tuple[int, int, int], factor: float) -> tuple[int, int, int]:
    red, green, blue = (round(level * factor) for level in colour)
    return red, green, blue


def _pen(stick: Stick, rng: np.random.Generator) -> Turned:
    """Make a ballpoint pen, with a cap or with a button and a grip; its clip looks roughly up."""
    return (_capped_pen if rng.random() < 0.5 else _button_pen)(stick, rng)


def _capped_pen(stick: Stick, rng: np.random.Generator) -> Turned:
    length, r = stick.length_m, stick.diameter_m / 2
    barrel, cap = 0.84 * r, 0.92 * r
    cap_start = float(rng.uniform(0.58, 0.7)) * length
    pale = (232, 232, 228) if rng.random() < 0.5 else stick.colour
    finishes = (
        Finish(colour=pale, roughness=0.3, coat=0.3, mottle=0.03),
        Finish(colour=stick.colour, roughness=0.25, coat=0.4, mottle=0.03),
    )
    tip = length - 2.2 * r
    return Turned(
        sections=(
            section(_dome(0.0, 0.6 * r, 0.7 * barrel), 1),
            section([(0.6 * r, 0.7 * barrel), (0.6 * r, barrel)], 0),
            section([(0.6 * r, barrel), (cap_start, barrel)], 0),
            section([(cap_start, barrel), (cap_start, 0.95 * cap), (cap_start + 0.15 * r, cap)], 1),
            section([(cap_start + 0.15 * r, cap), (tip, 0.97 * cap)], 1),
            section([(along, radius) for along, radius in _dome(length, tip, 0.97 * cap, 0.35)[::-1]], 1),
            section([(length, 0.35 * 0.97 * cap), (length, 0.0)], 1),
        ),
        finishes=finishes,
        extras=(_clip(cap_start + 0.04 * length, tip + 0.5 * r, cap, r, 1),),
        roll_deg=float(rng.uniform(-50, 50)),
    )


def _button_pen(stick: Stick, rng: np.random.Generator) -> Turned:
    length, r = stick.length_m, stick.diameter_m / 2
    barrel = 0.88 * r
    grip, cone = float(rng.uniform(0.6, 0.68)) * length, 0.9 * length
    ribs = np.linspace(grip, cone - 0.02 * length, 8 * 9 + 1)
    finishes = (
        Finish(colour=stick.colour, roughness=0.3, coat=0.3, mottle=0.03),
        STEEL if rng.random() < 0.6 else Finish(colour=_darker(stick.colour, 0.5), roughness=0.3),
        RUBBER,
    )
    return Turned(
        sections=(
            section(_dome(0.0, 0.3 * r, 0.42 * r), 1),
            section([(0.3 * r, 0.42 * r), (0.045 * length, 0.42 * r)], 1),
            section([(0.045 * length, 0.42 * r), (0.045 * length, 0.8 * barrel), (0.055 * length, barrel)], 1),
            section([(0.055 * length, barrel), (grip, barrel)], 0),
            Section(
                ribs, barrel * (0.97 + 0.03 * np.abs(np.sin(np.linspace(0, 8 * np.pi, len(ribs))))), 2, rippled=True
            ),
            section([(cone - 0.02 * length, 0.95 * barrel), (cone, 0.9 * barrel), (0.975 * length, 0.3 * r)], 1),
            section([(0.975 * length, 0.3 * r), (0.975 * length, 0.14 * r)], 1),
            section([(0.975 * length, 0.14 * r), (0.994 * length, 0.12 * r), (length, 0.04 * r), (length, 0.0)], 1),
        ),
        finishes=finishes,
        extras=(_clip(0.05 * length, 0.34 * length, barrel, r, 1),),
        roll_deg=float(rng.uniform(-45, 45)),
    )


def _clip(start_m: float, end_m: float, inner_m: float, outer_m: float, finish: int) -> Solid:
    """Build a clip along the top, from just inside the barrel to the radius of the rod that fell."""
    half, top = 0.22 * outer_m, 0.975 * outer_m  # its corners lie on the radius
    return box((start_m, -half, 0.9 * inner_m), (end_m, half, top), 0.03 * outer_m, finish)


def _pencil(stick: Stick, rng: np.random.Generator) -> Turned:
    """Make a lacquered pencil with six rounded sides, sharpened at its end, with or without a rubber at its start."""
    length, r = stick.length_m, stick.diameter_m / 2
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    # Two flats look down and up. A power mean of the distances of the six sides rounds the corners.
    sides = np.cos(angle[:, None] - np.pi / 2 - np.pi / 3 * np.arange(6))
    hexagon = r / np.sum(np.maximum(sides, 0.0) ** 24, axis=1) ** (1 / 24)
    hexagon *= r / hexagon.min()
    lead = 0.28 * r
    slope = np.tan(np.radians(float(rng.uniform(10.0, 12.5))))
    lead_start = length - (lead - 0.08 * r) / slope
    # The cone meets the sides farther back at the corners: the scallops of a sharpened pencil.
    edge = lead_start - (hexagon - lead) / slope
    with_rubber = rng.random() < 0.4
    body_start = 4.5 * r if with_rubber else 0.0
    finishes = (
        Finish(colour=stick.colour, roughness=0.3, coat=0.5, mottle=0.04),
        WOOD,
        GRAPHITE,
        BRASS if rng.random() < 0.5 else STEEL,
        Finish(colour=(206, 120, 116), roughness=0.8, mottle=0.15),
    )
    if with_rubber:
        collar = np.linspace(2.0 * r, body_start, 25)
        rings = 0.99 * r * (1 - 0.03 * (np.sin(np.linspace(0, 8 * np.pi, 25)) > 0))
        tail = [
            section(_dome(0.0, 0.4 * r, 0.93 * r, 0.6), 4),
            section([(0.4 * r, 0.93 * r), (2.0 * r, 0.93 * r)], 4),
            Section(collar, rings, 3, rippled=True),
        ]
    else:
        tail = [
            section([(0.0, 0.0), (0.0, lead)], 2),
            Section(np.zeros(2), np.stack([np.full(SIDES, lead), 0.97 * hexagon]), 1),
        ]
    body = Section(
        np.stack([np.full(SIDES, body_start), np.full(SIDES, body_start + 0.1 * r), edge]),
        np.stack([0.97 * hexagon, hexagon, hexagon]),
        0,
    )
    cone = Section(np.stack([edge, np.full(SIDES, lead_start)]), np.stack([hexagon, np.full(SIDES, lead)]), 1)
    tip = section([(lead_start, lead), (length, 0.08 * r), (length, 0.0)], 2)
    return Turned(sections=(*tail, body, cone, tip), finishes=finishes, roll_deg=60.0 * int(rng.integers(6)))


def _pipe(stick: Stick, rng: np.random.Generator) -> Turned:
    """Make a tube with open ends, of copper, aluminium, steel or plastic."""
    length, r = stick.length_m, stick.diameter_m / 2
    inner, depth = float(rng.uniform(0.72, 0.88)) * r, 4.0 * r
    finish = (
        Finish(colour=(206, 132, 96), roughness=0.32, metallic=1.0, mottle=0.3, grain_m=0.006, streaks=3.0),
        Finish(colour=(196, 198, 200), roughness=0.35, metallic=1.0, mottle=0.12, grain_m=0.003, streaks=10.0),
        STEEL,
        Finish(colour=stick.colour, roughness=0.4, mottle=0.05, grain_m=0.01),
    )[int(rng.integers(4))]
    edge = 0.06 * r
    return Turned(
        sections=(
            section([(depth, 0.0), (depth, inner)], 1),
            section([(depth, inner), (0.0, inner)], 1),
            section([(0.0, inner), (0.0, r - edge)], 0),
            section([(0.0, r - edge), (edge, r)], 0),
            section([(edge, r), (length - edge, r)], 0),
            section([(length - edge, r), (length, r - edge)], 0),
            section([(length, r - edge), (length, inner)], 0),
            section([(length, inner), (length - depth, inner)], 1),
            section([(length - depth, inner), (length - depth, 0.0)], 1),
        ),
        finishes=(finish, Finish(colour=_darker(finish.colour, 0.35), roughness=0.6, metallic=finish.metallic)),
    )


def _rod(stick: Stick, rng: np.random.Generator) -> Turned:
    """Make a metal rod, plain or threaded all along."""
    length, r = stick.length_m, stick.diameter_m / 2
    edge = 0.15 * r
    finish = (STEEL, DARK_STEEL, BRASS)[int(rng.integers(3))]
    if rng.random() < 0.4:
        # Rings stand for a helix: from the side they look the same.
        pitch = max(0.0005, 0.3 * r)
        turns = int((length - 2 * edge) / pitch)
        along = edge + (length - 2 * edge) * np.linspace(0, 1, 4 * turns + 1)
        middle = Section(along, r * np.tile([0.88, 0.94, 1.0, 0.94], turns + 1)[: len(along)], 0, rippled=True)
    else:
        middle = section([(edge, r), (length - edge, r)], 0)
    return Turned(
        sections=(
            section([(0.0, 0.0), (0.0, r - edge)], 0),
            section([(0.0, r - edge), (edge, 0.88 * r + 0.12 * r * (len(middle.along_m) == 2))], 0),
            middle,
            section([(length - edge, r), (length, r - edge)], 0),
            section([(length, r - edge), (length, 0.0)], 0),
        ),
        finishes=(finish,),
    )


def _screwdriver(stick: Stick, rng: np.random.Generator) -> Turned:
    """Make a screwdriver: a fluted plastic handle, a collar, and a steel shaft with a flat or a pointed tip."""
    length, r = stick.length_m, stick.diameter_m / 2
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    flutes = 1 - 0.09 * (0.5 - 0.5 * np.cos(int(rng.integers(6, 9)) * angle))
    handle = float(rng.uniform(0.4, 0.55)) * length
    shaft = float(rng.uniform(0.24, 0.34)) * r
    neck = handle - 1.6 * r
    places = np.array([1.2 * r, 2.2 * r, neck - 1.2 * r, neck])
    swell = np.array([1.0, 1.0, 1.0, 0.72])
    fluted = np.stack([np.full(SIDES, 1.0), flutes, flutes, np.full(SIDES, 1.0)])
    second = _darker(stick.colour, 0.25) if rng.random() < 0.6 else (30, 30, 32)
    finishes = (
        Finish(colour=stick.colour, roughness=0.25, coat=0.5, mottle=0.04),
        Finish(colour=second, roughness=0.45, mottle=0.05),
        STEEL,
        DARK_STEEL,
    )
    tip = length - 3.0 * shaft
    if rng.random() < 0.5:
        end = [
            Section(
                np.array([tip, length - 0.2 * shaft, length]),
                shaft * np.array([1.0, 1.05, 1.0]),
                3,
                np.array([1.0, 0.3, 0.25]),
            ),
            Section(np.array([length, length]), shaft * np.array([1.0, 0.0]), 3, np.array([0.25, 0.25])),
        ]
    else:
        end = [section([(tip, shaft), (tip + 1.5 * shaft, 0.9 * shaft), (length, 0.25 * shaft), (length, 0.0)], 3)]
    return Turned(
        sections=(
            section(_dome(0.0, 1.2 * r, r, 0.2), 1),
            section([(0.0, 0.0), (0.0, 0.2 * r)], 1),
            Section(places, r * swell[:, None] * fluted, 0),
            section([(neck, 0.72 * r), (neck + 0.4 * r, 0.7 * r), (handle - 0.3 * r, 0.8 * r), (handle, 0.7 * r)], 1),
            section([(handle, 0.7 * r), (handle, shaft)], 1),
            section([(handle, shaft), (tip, shaft)], 2),
            *end,
        ),
        finishes=finishes,
    )


TURNERS: Mapping[StickKind, Callable[[Stick, np.random.Generator], Turned]] = {
    StickKind.PEN: _pen,
    StickKind.PENCIL: _pencil,
    StickKind.PIPE: _pipe,
    StickKind.ROD: _rod,
    StickKind.SCREWDRIVER: _screwdriver,
}
