"""The simulation of the cables' fall: its simulator and settings. Accuracy costs time; the defaults pass every gate.

A simulator is a member of `Simulator`, a model of its settings, and a field of `Fall` that bears the simulator's name.
The simulator's code is the folder of `worker/simulate` with the same name.
"""

from enum import StrEnum
from types import MappingProxyType
from typing import Annotated

from pydantic import BeforeValidator, Field
from pydantic_core import PydanticCustomError

from farm.model import Model


class Simulator(StrEnum):
    """The simulator of the cables' fall: the farm's own rod solver, or Blender's cloth in one joined mesh."""

    ROD = "rod"
    CLOTH = "cloth"


WITHDRAWN = MappingProxyType({"cloth-published": "nothing warrants that it repeats; ask for 'rod' or 'cloth'"})
"""Simulators that the farm no longer offers, each with the reason and the simulators to ask for instead."""

WITHDRAWN_FAULT = "withdrawn_simulator"
"""Type of the validation error that a withdrawn simulator's name raises."""


def _refuse_withdrawn(value: object) -> object:
    if isinstance(value, str) and value in WITHDRAWN:
        raise PydanticCustomError(
            WITHDRAWN_FAULT,
            "'{name}' is no longer offered, as {reason}",
            {"name": value, "reason": WITHDRAWN[value]},
        )
    return value


AskedSimulator = Annotated[Simulator, BeforeValidator(_refuse_withdrawn)]
"""A simulator in a description; one that was withdrawn is refused by its name."""


class RodFall(Model):
    """Settings of the rod solver.

    Attributes:
        steps_per_s: time steps per second of the fall.
        segment_radii: length of a segment over the cable's radius in knots; elsewhere up to half as much again, and
            less in tight curves.
        max_time_s: seconds after which a fall that has not come to rest is given up, and another scene is drawn.
    """

    steps_per_s: Annotated[int, Field(ge=100, le=100_000)] = 1000
    segment_radii: Annotated[float, Field(ge=1, le=20)] = 4.0
    max_time_s: Annotated[float, Field(gt=0, le=60)] = 4.0


class ClothFall(Model):
    """Settings of Blender's cloth.

    Attributes:
        max_frames: frames after which a fall that has not come to rest is given up, and another scene is drawn.
        quality: the solver's steps in a frame.
        collision_quality: the solver's steps in a frame for collisions.
    """

    max_frames: Annotated[int, Field(ge=10, le=2000)] = 250
    quality: Annotated[int, Field(ge=1, le=80)] = 10
    collision_quality: Annotated[int, Field(ge=1, le=20)] = 8


class Fall(Model):
    """Settings of every simulator, each under the simulator's name.

    Attributes:
        max_attempts: scenes that may be drawn for one picture, until one passes every gate.
    """

    max_attempts: Annotated[int, Field(ge=1, le=50)] = 8
    rod: RodFall = RodFall()
    cloth: ClothFall = ClothFall()

    def settings_of(self, simulator: Simulator) -> Model:
        """Return the settings of one simulator."""
        settings: Model = getattr(self, simulator.value)
        return settings
