"""What acts on the rods from outside, as compiled code reads it."""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array, Surroundings

DYING_DOWN_S = 0.1
"""How long the wind takes to die down."""


class World(NamedTuple):
    """See `worker.simulate.rod.model.Surroundings`.

    Attributes:
        gravity: (3,) m/s^2.
        floor: whether there is one.
        friction_floor: Coulomb's coefficient.
        friction_rods: Coulomb's coefficient.
        air: (3,) mean velocity of the wind, m/s.
        gusts: (K, 3) share of the mean, angular frequency and phase of each swing.
        calm_from: when the wind begins to die down, s.
        drag: whether the air resists.
        resistance: m/s^2, at which dry resistance slows rods that touch something.
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
    """The same in arrays."""
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
    """Velocity of the air, m/s: the mean with its gusts, until it dies down."""
    strength = 1.0
    for k in range(len(world.gusts)):
        strength += world.gusts[k, 0] * np.sin(world.gusts[k, 1] * time + world.gusts[k, 2])
    strength *= min(max(1.0 - (time - world.calm_from) / DYING_DOWN_S, 0.0), 1.0)
    for c in range(3):
        air[c] = strength * world.air[c]
