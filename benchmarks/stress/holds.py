"""The kinds of things that a drawn scene holds, by which its faults are counted."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from farm.scene.cable import Bundle, Cable
from farm.scene.scene import Scene
from worker.sample.cable_curve import FINE_KNOTS
from worker.simulate.rod.fall import STICK_DENSITY_KG_M3, STICK_YOUNGS_MODULUS_PA

WIDER = 2.0
"""Ratio of two radii above which one rod counts as thin and the other as thick."""

HEAVIER = 2.0
"""Ratio of two masses per length above which one rod counts as light and the other as heavy."""


class Holding(Enum):
    """What a scene holds; it may hold several."""

    COIL = "coil"
    """A cable whose natural curve turns one way all along."""
    LOOP = "loop"
    """A cable with a loop."""
    BUNDLE = "bundle"
    """A bundle of strands, which falls as one cable."""
    STICK = "stick"
    """A pen, a pipe or another stick."""
    KNOT = "knot"
    """A cable with a knot."""
    WOVEN = "woven"
    """A cable that starts over and under others: a heap, a threaded loop, or crossed groups."""
    PEG = "peg"
    """A cable round a peg."""
    THIN_ON_THICK = "thin over thick"
    """A cable that starts above a rod more than `WIDER` times as thick."""
    THICK_ON_THIN = "thick over thin"
    """A cable that starts above a rod less than 1 / `WIDER` times as thick."""
    LIGHT_STIFF = "light stiff on heavy"
    """A cable that starts above a rod more than `HEAVIER` times as heavy, and bends less than that one does."""
    PLAIN = "plain"
    """None of these."""


@dataclass(frozen=True, slots=True)
class _Body:
    """A cable or a stick: the height at which it starts, m, its radius, m, mass per length, kg/m, and EI, N m^2."""

    start_m: float
    radius_m: float
    mass_kg_m: float
    stiffness_n_m2: float


def held_by(scene: Scene) -> tuple[Holding, ...]:
    """List what a scene holds, in the order of `Holding`."""
    found = set(_single(scene)) | set(_pairs(scene))
    return tuple(each for each in Holding if each in found) or (Holding.PLAIN,)


def _single(scene: Scene) -> Iterator[Holding]:
    for cable in scene.cables:
        if isinstance(cable.material, Bundle):
            yield Holding.BUNDLE
        if cable.knot is not None:
            yield Holding.KNOT
        elif cable.heights_m:
            yield Holding.WOVEN
        elif len(cable.bends_per_m) == FINE_KNOTS:
            yield Holding.COIL if _is_even(cable) else Holding.LOOP
    if scene.sticks:
        yield Holding.STICK
    if scene.pegs:
        yield Holding.PEG


def _is_even(cable: Cable) -> bool:
    """Whether the curvature is about the same all along; a loop's is large in its middle alone."""
    bends = np.array(cable.bends_per_m)
    return bool((bends * bends.mean() > 0).all() and np.abs(bends).min() > 0.5 * np.abs(bends.mean()))


def _pairs(scene: Scene) -> Iterator[Holding]:
    bodies = list(_bodies(scene))
    for upper in bodies[: len(scene.cables)]:
        for lower in bodies:
            if lower.start_m >= upper.start_m:
                continue
            if lower.radius_m > WIDER * upper.radius_m:
                yield Holding.THIN_ON_THICK
            if upper.radius_m > WIDER * lower.radius_m:
                yield Holding.THICK_ON_THIN
            if lower.mass_kg_m > HEAVIER * upper.mass_kg_m and upper.stiffness_n_m2 > lower.stiffness_n_m2:
                yield Holding.LIGHT_STIFF


def _bodies(scene: Scene) -> Iterator[_Body]:
    """All cables, then all sticks."""
    cables = [
        (each.start_height_m, each.diameter_m / 2, each.density_kg_m3, each.youngs_modulus_pa) for each in scene.cables
    ]
    sticks = [
        (each.start_height_m, each.diameter_m / 2, STICK_DENSITY_KG_M3[each.kind], STICK_YOUNGS_MODULUS_PA)
        for each in scene.sticks
    ]
    for start, radius, density, modulus in cables + sticks:
        yield _Body(start, radius, float(density * np.pi * radius**2), float(modulus * np.pi * radius**4 / 4))
