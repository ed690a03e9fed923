"""Samples clutter: objects on the floor that are not cables."""

import numpy as np

from farm.model import Rgb, Vector2
from farm.scene.clutter import Part, PartKind, Peg, Sheet, SheetKind, Stick, StickKind
from farm.spec.ranges.clutter import ClutterRanges
from farm.spec.ranges.placement import SPACING_DIAMETERS
from worker.sample.values import chance, level, log_uniform, pattern_seed, rgb, uniform

_REACH = 0.45
"""Largest distance of an object's middle from the picture's middle, along each axis, as a share of the picture's edge
along that axis."""

_SHEET_SIZES_M: dict[SheetKind, tuple[tuple[float, float], tuple[float, float]]] = {
    SheetKind.TAPE: ((0.05, 0.5), (0.010, 0.050)),
    SheetKind.HAZARD_TAPE: ((0.15, 0.6), (0.025, 0.050)),
    SheetKind.PAPER: ((0.10, 0.21), (0.07, 0.15)),
    SheetKind.LABEL: ((0.02, 0.07), (0.012, 0.035)),
    SheetKind.RULER: ((0.15, 0.31), (0.013, 0.030)),
    SheetKind.PAINTED_LINE: ((0.3, 0.8), (0.003, 0.030)),
    SheetKind.SLOT: ((0.2, 0.8), (0.002, 0.008)),
    SheetKind.SEAM: ((0.6, 0.8), (0.0006, 0.002)),
}
"""Ranges of the length and of the width of each kind of sheet, in metres."""

_PART_SIZES_M: dict[PartKind, tuple[float, float]] = {
    PartKind.WASHER: (0.007, 0.016),
    PartKind.NUT: (0.006, 0.015),
    PartKind.SCREW: (0.010, 0.025),
    PartKind.CONNECTOR: (0.008, 0.025),
    PartKind.CABLE_TIE: (0.020, 0.060),
}
"""Range of the length or diameter of each kind of part, in metres."""

_SLENDER = 9.0
"""Least length of a stick, in its diameters: a shorter one would not look like a cable."""


def sample_sticks(ranges: ClutterRanges, seen_m: Vector2, rng: np.random.Generator) -> tuple[Stick, ...]:
    """Sample sticks that start one above the other, from the floor up.

    Args:
        ranges: ranges of the style.
        seen_m: width and height of the picture on the floor, in metres.
        rng: random generator of the clutter.
    """
    sticks: list[Stick] = []
    start = 0.0005
    for _ in range(level(rng, ranges.sticks)):
        kind = list(StickKind)[int(rng.integers(len(StickKind)))]
        # A stick thicker than a tenth of the picture would look like a wall.
        diameter = min(log_uniform(rng, ranges.stick_diameter_m), 0.1 * min(seen_m))
        sticks.append(
            Stick(
                kind=kind,
                diameter_m=diameter,
                length_m=max(uniform(rng, ranges.stick_length_m), _SLENDER * diameter),
                x_m=_place(seen_m[0], rng),
                y_m=_place(seen_m[1], rng),
                start_height_m=start,
                rotation_deg=float(rng.uniform(0.0, 360.0)),
                colour=rgb(rng, (0, 255)),
                pattern_seed=pattern_seed(rng),
            )
        )
        start += SPACING_DIAMETERS * diameter
    return tuple(sticks)


def is_clear_of_peg(stick: Stick, peg: Peg) -> bool:
    """Whether a stick starts clear of a peg by a quarter of its own diameter; one that does not is left out."""
    turn = np.radians(stick.rotation_deg)
    x, y = peg.x_m - stick.x_m, peg.y_m - stick.y_m
    along = float(np.clip(np.cos(turn) * x + np.sin(turn) * y, -stick.length_m / 2, stick.length_m / 2))
    away = np.hypot(x - along * np.cos(turn), y - along * np.sin(turn))
    return bool(away > peg.diameter_m / 2 + 0.75 * stick.diameter_m)


def sample_sheets(ranges: ClutterRanges, seen_m: Vector2, rng: np.random.Generator) -> tuple[Sheet, ...]:
    """Sample flat objects, the lowest first; the arguments are those of `sample_sticks`."""
    sheets: list[Sheet] = []
    for _ in range(level(rng, ranges.sheets)):
        kind = list(SheetKind)[int(rng.integers(len(SheetKind)))]
        lengths, widths = _SHEET_SIZES_M[kind]
        sheets.append(
            Sheet(
                kind=kind,
                x_m=_place(seen_m[0], rng),
                y_m=_place(seen_m[1], rng),
                rotation_deg=float(rng.uniform(0.0, 360.0)),
                length_m=uniform(rng, lengths),
                width_m=log_uniform(rng, widths),
                colour=_sheet_colour(kind, rng),
                pattern_seed=pattern_seed(rng),
            )
        )
    return tuple(sheets)


def sample_parts(ranges: ClutterRanges, seen_m: Vector2, rng: np.random.Generator) -> tuple[Part, ...]:
    """Sample small objects; the arguments are those of `sample_sticks`."""
    parts: list[Part] = []
    for _ in range(level(rng, ranges.parts)):
        kind = list(PartKind)[int(rng.integers(len(PartKind)))]
        parts.append(
            Part(
                kind=kind,
                x_m=_place(seen_m[0], rng),
                y_m=_place(seen_m[1], rng),
                rotation_deg=float(rng.uniform(0.0, 360.0)),
                size_m=log_uniform(rng, _PART_SIZES_M[kind]),
                colour=rgb(rng, (0, 255)),
                pattern_seed=pattern_seed(rng),
            )
        )
    return tuple(parts)


def _place(edge_m: float, rng: np.random.Generator) -> float:
    return float(rng.uniform(-_REACH, _REACH)) * edge_m


def _sheet_colour(kind: SheetKind, rng: np.random.Generator) -> Rgb:
    """Sample a sheet's colour: pale paper, dark slots and seams, mostly grey rulers; others may have any colour."""
    colour = rgb(rng, (0, 255))
    grey = int(rng.integers(150, 215)) if kind is SheetKind.RULER else int(rng.integers(10, 60))
    if kind in {SheetKind.SLOT, SheetKind.SEAM} or (kind is SheetKind.RULER and chance(rng, 0.6)):
        return (grey, grey, grey)
    if kind in {SheetKind.PAPER, SheetKind.LABEL}:
        pale = 255 - np.array(colour) // 12
        return (int(pale[0]), int(pale[1]), int(pale[2]))
    return colour
