"""The surroundings of the rods, in the form that compiled code reads."""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array, Surroundings

DYING_DOWN_S = 0.1
"""Time that the wind takes to die down, in seconds."""


class World(NamedTuple):
    """The forces and surfaces that act on the rods; see `worker.simulate.rod.model.Surroundings`.

    Attributes:
        gravity: (3,) gravity, m/s^2.
        floor: whether there is a floor at z = 0.
        friction_floor: Coulomb's coefficient between a rod and the floor.
        friction_rods: Coulomb's coefficient between two rods.
        air: (3,) mean velocity of the wind, m/s.
        gusts: (K, 3) amplitude as a share of the mean, angular frequency, rad/s, and phase, rad, of each oscillation.
        calm_from: time at which the wind begins to die down, s.
        drag: whether the air resists the rods' motion.
        resistance: deceleration by dry resistance of rods that touch something, m/s^2.
    """

    gravity: Array
    floor: bool
    friction_floor: float
    friction_rods: float
    air: Array
    gusts: Array
    calm_from: float
    drag: bool
    resistance: float


def world_of(surroundings: Surroundings) -> World:
    """Convert surroundings to arrays and numbers."""
    breeze = surroundings.breeze
    return World(
        gravity=np.array(surroundings.gravity_m_s2, dtype=np.float64),
        floor=surroundings.floor,
        friction_floor=float(surroundings.friction_floor),
        friction_rods=float(surroundings.friction_rods),
        air=np.zeros(3) if breeze is None else np.array(breeze.velocity_m_s, dtype=np.float64),
        gusts=np.zeros((0, 3)) if breeze is None else np.array(breeze.gusts, dtype=np.float64).reshape(-1, 3),
        calm_from=0.0 if breeze is None else float(breeze.until_s),
        drag=breeze is not None,
        resistance=float(surroundings.resistance * np.linalg.norm(surroundings.gravity_m_s2)),
    )


@compiled
def air_velocity(world: World, time: float, air: Array) -> None:
    """Set `air` (3,) to the velocity of the air at a time, s: the mean with its gusts, which dies down, in m/s."""
    strength = 1.0
    for k in range(len(world.gusts)):
        strength += world.gusts[k, 0] * np.sin(world.gusts[k, 1] * time + world.gusts[k, 2])
    strength *= min(max(1.0 - (time - world.calm_from) / DYING_DOWN_S, 0.0), 1.0)
    for c in range(3):
        air[c] = strength * world.air[c]
