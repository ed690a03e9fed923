"""What the stress test's scenes are drawn from: one number on each axis, and one of the starts.

The axes are sampled as a Latin hypercube: each is cut into as many layers as there are scenes, and each layer is used
once. A twentieth of the scenes lies exactly at either end of each axis.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

EXTREME_SHARE = 0.05
"""Share of the scenes that lie at one end of an axis."""

CROWD = 32
"""Cables of a crowded scene, more than the axis has."""

CROWD_SHARE = 0.02
"""Share of the scenes that are crowded."""

NODE_BUDGET = 1000
"""Segments of all cables together, about: where there are many cables, they are shorter."""

SEGMENT_RADII = 4.0
"""Length of a segment over the radius, the default of drawn scenes."""

MIN_LENGTH_RADII = 48.0
"""Least length of a cable, in radii: a dozen segments."""

_SEED_STREAM, _SCENE_STREAM = 0, 1


class Start(Enum):
    """How the cables of a scene start."""

    STACKED = "stacked"
    """Level and bent, one above the other, as drawn scenes do."""
    OVERLAPPING = "overlapping"
    """The same, their axes half a radius above each other, so that they cut into each other wherever they cross."""
    ONE_HEIGHT = "one height"
    """All axes at one height, so that they meet wherever they cross, and no side is the right one."""
    COINCIDENT = "coincident"
    """Pairs of cables, the one in the place of the other."""
    UPRIGHT = "upright"
    """Standing on their ends, side by side, with the small bend that any cable has."""
    AT_FLOOR = "at the floor"
    """Lying on the floor and on each other, touching all along the height of the pile."""
    IN_FLOOR = "in the floor"
    """The same, tilted so that the pile's one side is below the floor."""
    THROWN = "thrown"
    """Stacked, with 2 to 8 m/s in any direction, each cable its own."""


HOSTILE = tuple(start for start in Start if start is not Start.STACKED)
"""Half of the scenes start in one of these ways."""


class Scale(Enum):
    """How an axis is divided."""

    LINEAR = "linear"
    LOGARITHMIC = "logarithmic"
    SQUARE = "square"


@dataclass(frozen=True, slots=True)
class Axis:
    """One parameter's range."""

    name: str
    unit: str
    low: float
    high: float
    scale: Scale

    def at(self, share: float) -> float:
        """The value at a share of the axis, 0 to 1; the extremes are returned to the bit."""
        if share in {0.0, 1.0}:
            return self.high if share else self.low
        if self.scale is Scale.LOGARITHMIC:
            return float(self.low * (self.high / self.low) ** share)
        return float(self.low + (self.high - self.low) * (share**2 if self.scale is Scale.SQUARE else share))


AXES = (
    Axis("density", "kg/m3", 100.0, 20_000.0, Scale.LOGARITHMIC),
    Axis("modulus", "Pa", 1e5, 1e10, Scale.LOGARITHMIC),
    Axis("radius", "m", 0.000_25, 0.010, Scale.LOGARITHMIC),
    Axis("wind", "m/s", 0.0, 20.0, Scale.SQUARE),
    Axis("drop", "m", 0.0, 1.0, Scale.SQUARE),
    Axis("steps", "1/s", 100.0, 2000.0, Scale.LOGARITHMIC),
    Axis("cables", "", 1.0, 16.0, Scale.LOGARITHMIC),
    # Without friction nothing that slides ever stops.
    Axis("friction_floor", "", 0.1, 2.0, Scale.LOGARITHMIC),
    Axis("friction_cable", "", 0.0, 2.0, Scale.SQUARE),
    # How far a cable's natural shape turns from end to end: up to a loop and a half.
    Axis("turn", "rad", 0.0, 10.0, Scale.SQUARE),
    Axis("length", "radii", MIN_LENGTH_RADII, 400.0, Scale.LOGARITHMIC),
)


@dataclass(frozen=True, slots=True)
class Case:
    """One scene of the stress test.

    Attributes:
        seed: seed of the whole test.
        runs: number of the test's scenes.
        number: the scene's number among them; with `seed` and `runs` it says which scene this is.
        start: the way that the cables start.
        density: density of the scene's first cable, in kg/m3.
        modulus: Young's modulus of that cable, in Pa.
        radius: radius of that cable, in m.
        wind: mean speed of the wind, in m/s.
        drop: height of the lowest cable above the floor, in m.
        steps: time steps per second.
        cables: number of cables.
        friction_floor: Coulomb's coefficient on the floor.
        friction_cable: Coulomb's coefficient between cables.
        turn: angle by which the natural shape turns over the length, in rad.
        length: length over `radius`; less where many cables would have too many nodes.
        aligned: whether the cables lie in a bundle.
        mixed: whether each cable has its own radius, density and modulus.
    """

    seed: int
    runs: int
    number: int
    start: Start
    aligned: bool
    mixed: bool
    density: float
    modulus: float
    radius: float
    wind: float
    drop: float
    steps: float
    cables: int
    friction_floor: float
    friction_cable: float
    turn: float
    length: float

    def generator(self) -> np.random.Generator:
        """What else is drawn for this scene."""
        sequence = np.random.SeedSequence(self.seed, spawn_key=(_SCENE_STREAM, self.runs, self.number))
        return np.random.Generator(np.random.PCG64(sequence))


def draw_cases(runs: int, seed: int) -> list[Case]:
    """The scenes of one stress test; the same numbers give the same scenes."""
    rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(_SEED_STREAM, runs))))
    shares = {axis.name: _layers(rng, runs) for axis in AXES}
    crowd = rng.permutation(runs) < round(CROWD_SHARE * runs)
    starts = [Start.STACKED if k % 2 else HOSTILE[k // 2 % len(HOSTILE)] for k in range(runs)]
    starts = [starts[k] for k in rng.permutation(runs)]
    aligned, mixed = rng.permutation(runs) % 2 == 0, rng.permutation(runs) % 2 == 0
    cases = []
    for number in range(runs):
        values = {axis.name: axis.at(float(shares[axis.name][number])) for axis in AXES}
        cables = CROWD if crowd[number] else round(values.pop("cables"))
        values.pop("cables", None)
        if starts[number] in {Start.OVERLAPPING, Start.ONE_HEIGHT, Start.COINCIDENT}:
            cables = max(cables, 2)
        most = max(NODE_BUDGET * SEGMENT_RADII / cables, MIN_LENGTH_RADII)
        values["length"] = min(values["length"], most)
        cases.append(
            Case(
                seed=seed,
                runs=runs,
                number=number,
                start=starts[number],
                aligned=bool(aligned[number]),
                mixed=bool(mixed[number]),
                cables=cables,
                **values,
            )
        )
    return cases


def _layers(rng: np.random.Generator, runs: int) -> NDArray[np.float64]:
    """One number in each layer of 0 to 1, in any order, stretched so that some lie at the ends."""
    layers = (rng.permutation(runs) + rng.random(runs)) / runs
    stretched: NDArray[np.float64] = np.clip((layers - EXTREME_SHARE) / (1 - 2 * EXTREME_SHARE), 0.0, 1.0)
    return stretched
