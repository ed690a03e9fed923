"""Lays cables in plan view: where they are, how they bend, and a choice of over and under that is left to chance."""

import numpy as np

from farm.scene.cable import Cable
from worker.sample.diagram import Choice
from worker.sample.meetings import Array

TIGHTEST_DIAMETERS = 4.0
"""Least radius of a bend, in diameters of the cable."""

_REACH = 0.15
"""Largest distance of what makes a tangle from the picture's middle along each axis, as a share of its shorter edge."""

_CURL_KNOTS = (33, 257)
"""Fewest and most points that describe the curvature of a cable with a loop, or one that runs round a peg."""


def at_place(cable: Cable, place_m: Array) -> Cable:
    """Lay the middle of a cable's length at a place (2,)."""
    return cable.model_copy(update={"x_m": float(place_m[0]), "y_m": float(place_m[1])})


def curled(cable: Cable, bend_per_m: float, middle_m: float, arc_m: float) -> Array:
    """Curl a gently bent cable to an arc of `arc_m` metres about a place along it; return the curvatures, in 1/m."""
    ramp_m = 0.5 / abs(bend_per_m)
    count = int(np.clip(np.ceil(2 * cable.length_m / ramp_m), *_CURL_KNOTS))
    along = np.linspace(0.0, cable.length_m, count)
    share = np.clip(0.5 + (arc_m / 2 - np.abs(along - middle_m)) / (2 * ramp_m), 0.0, 1.0)
    share = share * share * (3 - 2 * share)
    rest = np.interp(along, np.linspace(0.0, cable.length_m, len(cable.bends_per_m)), gentle(cable, 4.0))
    curvatures: Array = bend_per_m * share + (1 - share) * rest
    return curvatures


def at_random(rng: np.random.Generator) -> Choice:
    """Choose over or under for each meeting, each as likely."""
    return lambda meetings, _: (rng.random(len(meetings)) < 0.5).tolist()


def eased(bends_per_m: Array, cable: Cable) -> Array:
    """Limit curvatures to what a cable of its thickness takes."""
    tightest = 1 / (TIGHTEST_DIAMETERS * cable.diameter_m)
    eased: Array = np.clip(bends_per_m, -tightest, tightest)
    return eased


def gentle(cable: Cable, most_per_m: float) -> Array:
    """Limit the curvatures of a cable, of which a coil or a loop may have been drawn."""
    return eased(np.clip(cable.bends_per_m, -most_per_m, most_per_m), cable)


def place_near_middle(edge_m: float, rng: np.random.Generator) -> Array:
    """Draw a place (2,) near the picture's middle, whose shorter edge is `edge_m` metres."""
    return rng.uniform(-_REACH, _REACH, 2) * edge_m


def moved(cable: Cable, place_m: Array, bearing_deg: float, bends_per_m: Array) -> Cable:
    """Lay a cable, level and without a rise, with its middle at a place (2,)."""
    return cable.model_copy(
        update={
            "x_m": float(place_m[0]),
            "y_m": float(place_m[1]),
            "rotation_deg": bearing_deg,
            "bends_per_m": tuple(float(bend) for bend in bends_per_m),
            "rise_m": 0.0,
        }
    )
