"""A cable on a floor that crosses a rigid ridge: the length that it lifts off, and the forces that carry it.

An Euler-Bernoulli beam under its own weight follows EI y'''' = -w. Slope and curvature are zero at the touchdowns at
x = +-a, and y = d, y' = 0 on the ridge at x = 0. With t = 1 - |x|/a the solution is

    y = d (4 t^3 - 3 t^4),    a = (72 EI d / w)^(1/4),

so the ridge carries 4 w a / 3 and each touchdown w a / 3, besides the weight of the part that lies there. The solution
holds for d much smaller than a. The lift d is that of the centreline over its height on the floor: if a cable lies
across another one of the same radius r, d is 2 r.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares


@dataclass(frozen=True, slots=True)
class RidgeCrossing:
    """The solution for a cable and a ridge.

    Attributes:
        bending_stiffness_n_m2: bending stiffness EI.
        weight_per_length_n_m: weight per length w.
        lift_m: lift d of the centreline over the ridge.
    """

    bending_stiffness_n_m2: float
    weight_per_length_n_m: float
    lift_m: float

    def __post_init__(self) -> None:
        """Raises ValueError unless all three are positive."""
        if not min(self.bending_stiffness_n_m2, self.weight_per_length_n_m, self.lift_m) > 0:
            raise ValueError("stiffness, weight and lift must be positive")

    @property
    def lift_off_m(self) -> float:
        """Half the length a that is in the air."""
        return float((72 * self.bending_stiffness_n_m2 * self.lift_m / self.weight_per_length_n_m) ** 0.25)

    @property
    def ridge_reaction_n(self) -> float:
        """Force of the ridge on the cable."""
        return 4 * self.weight_per_length_n_m * self.lift_off_m / 3

    @property
    def touchdown_reaction_n(self) -> float:
        """Force of the floor at each of the two touchdowns, besides the weight of the part that lies there."""
        return self.weight_per_length_n_m * self.lift_off_m / 3

    def height_m(self, distance_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Lift of the centreline at distances (N,) of either sign from the ridge."""
        return self.lift_m * lifted(distance_m / self.lift_off_m)


def lifted(distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lift as a share of that on the ridge, at distances (N,) from it in units of the lift-off length."""
    inward = np.maximum(1 - np.abs(distance), 0)
    result: NDArray[np.float64] = inward**3 * (4 - 3 * inward)
    return result


@dataclass(frozen=True, slots=True)
class LiftedFit:
    """The lifted shape that fits a cable best.

    Attributes:
        lift_off_m: half the length in the air.
        place_m: position of the ridge along the cable.
        lift_m: lift on the ridge.
        misfit: root mean square distance of the nodes in the air from the shape, as a share of the lift.
    """

    lift_off_m: float
    place_m: float
    lift_m: float
    misfit: float


def fit_lifted(along_m: NDArray[np.float64], lift_m: NDArray[np.float64]) -> LiftedFit:
    """Find where a cable lifts off, from nodes that may be far apart.

    That place can't be read from the nodes: the lift grows with the third power of the distance from it, so a tenth of
    the length further in it is 0.4 % of the ridge's, less than the error of a contact. But the shape is known up to its
    length, place and height. These three are fitted to all nodes, so the high nodes decide, whose lift is certain.

    Args:
        along_m: position of each node along the cable, rising, (N,).
        lift_m: height of each node over the one that it has when it lies on the floor, (N,).

    Raises:
        ValueError: if fewer than four nodes are in the air.
    """
    top = int(lift_m.argmax())
    raised = np.maximum(lift_m, 0)
    area = float(np.sum((raised[1:] + raised[:-1]) / 2 * np.diff(along_m)))
    if not (lift_m[top] > 0 and np.count_nonzero(lift_m > 0.01 * lift_m[top]) >= 4):
        raise ValueError("fewer than four nodes are in the air")
    # The shape's area is 0.8 of its height times half its length.
    half = area / (0.8 * lift_m[top])
    scale = np.array([half, half, lift_m[top]])

    def misfits(guess: NDArray[np.float64]) -> NDArray[np.float64]:
        length, place, height = guess * scale
        result: NDArray[np.float64] = (height * lifted((along_m - place) / length) - lift_m) / lift_m[top]
        return result

    start = np.array([half, along_m[top], lift_m[top]]) / scale
    fit = least_squares(misfits, start, xtol=1e-12, ftol=1e-12).x
    length, place, height = fit * scale
    in_air = misfits(fit)[np.abs(along_m - place) < length]
    return LiftedFit(float(length), float(place), float(height), float(np.sqrt(np.mean(in_air**2))))
