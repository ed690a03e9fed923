"""Draw the stress test's scenes: a value on each axis, and one of the starts.

The axes are sampled as a Latin hypercube: each is divided into as many layers as there are scenes, and each layer is
used once. On each axis, a twentieth of the scenes lies exactly at either end.
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
"""Approximate number of segments of all cables together: cables are shorter where there are many."""

SEGMENT_RADII = 4.0
"""Length of a segment over the radius, the default of drawn scenes."""

MIN_LENGTH_RADII = 48.0
"""Least length of a cable, in radii: a dozen segments."""

MOST_STEPS = 2000
"""Time steps of a run at most, unless the command line says otherwise. A third of the runs need more, up to 33,000,
most of them thin cables that the wind drags along; to their ends they would take two thirds of the time of all."""

_SEED_STREAM, _SCENE_STREAM = 0, 1
"""First spawn keys of the random streams for the cases, and for everything else that is drawn in each scene."""


class Start(Enum):
    """The start of a scene's cables."""

    STACKED = "stacked"
    """The cables are level and bent, one above the other, as in drawn scenes."""
    OVERLAPPING = "overlapping"
    """The cables are stacked with half a radius between their axes, so that they overlap wherever they cross."""
    ONE_HEIGHT = "one height"
    """All axes are at one height, so that they meet wherever they cross, and neither side is the right one."""
    COINCIDENT = "coincident"
    """The cables are pairs, the two of a pair in the same place."""
    UPRIGHT = "upright"
    """The cables stand on their ends, side by side, with the small bend that any cable has."""
    AT_FLOOR = "at the floor"
    """The cables lie on the floor and on each other, and touch all the way up the pile."""
    IN_FLOOR = "in the floor"
    """The cables lie in such a pile, tilted so that one side of it is below the floor."""
    THROWN = "thrown"
    """The cables are stacked, and each starts with its own velocity of 2 to 8 m/s in any direction."""


HOSTILE = tuple(start for start in Start if start is not Start.STACKED)
"""The starts that no drawn scene has; half of the scenes have one of them."""


class Scale(Enum):
    """The scale of an axis: how its values are spread between its ends."""

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
    # Without friction a sliding cable would never stop.
    Axis("friction_floor", "", 0.1, 2.0, Scale.LOGARITHMIC),
    Axis("friction_cable", "", 0.0, 2.0, Scale.SQUARE),
    # The turn of a cable's natural shape from end to end: up to a loop and a half.
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
        aligned: whether the cables lie in a bundle.
        mixed: whether each cable has its own radius, density and modulus.
        density: density of the scene's first cable, kg/m3.
        modulus: Young's modulus of the first cable, Pa.
        radius: radius of the first cable, m.
        wind: mean speed of the wind, m/s.
        drop: height of the lowest cable above the floor, m.
        steps: time steps of the solver per second.
        cables: number of cables.
        friction_floor: Coulomb's coefficient of friction between a cable and the floor.
        friction_cable: Coulomb's coefficient of friction between two cables.
        turn: turn of the natural shape from end to end, rad.
        length: length of a cable in units of `radius`, limited by `NODE_BUDGET`.
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
        """The generator for everything else that is drawn in this scene."""
        sequence = np.random.SeedSequence(self.seed, spawn_key=(_SCENE_STREAM, self.runs, self.number))
        return np.random.Generator(np.random.PCG64(sequence))


def draw_cases(runs: int, seed: int) -> list[Case]:
    """Draw the scenes of a stress test; the same number of runs and seed give the same scenes."""
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
    """Draw a number in each layer of 0 to 1, in random order, stretched so that `EXTREME_SHARE` lies at either end."""
    layers = (rng.permutation(runs) + rng.random(runs)) / runs
    stretched: NDArray[np.float64] = np.clip((layers - EXTREME_SHARE) / (1 - 2 * EXTREME_SHARE), 0.0, 1.0)
    return stretched
