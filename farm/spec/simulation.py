"""How the cables fall: which simulator, at which settings. More accuracy costs time; the defaults pass every gate."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from farm.model import Model


class Simulator(StrEnum):
    """What lets the cables fall.

    `ROD` is the farm's own rod solver; `CLOTH` is Blender's cloth, in one joined mesh; `CLOTH_PUBLISHED` is the
    published set-up of eight cloth objects over 100 frames, for comparison only: nothing warrants that it repeats.
    """

    ROD = "rod"
    CLOTH = "cloth"
    CLOTH_PUBLISHED = "cloth-published"


class RodFall(Model):
    """Settings of the rod solver.

    Attributes:
        steps_per_s: time steps per second of the fall.
        segment_radii: length of a segment over the cable's radius.
        max_time_s: a fall that has not come to rest by then is captured as it is, and fails its gate.
    """

    steps_per_s: Annotated[int, Field(ge=100, le=100_000)] = 1000
    segment_radii: Annotated[float, Field(ge=1, le=20)] = 4.0
    max_time_s: Annotated[float, Field(gt=0, le=60)] = 4.0


class ClothFall(Model):
    """Settings of Blender's cloth: frames, and solver steps a frame for the cloth and for its collisions."""

    max_frames: Annotated[int, Field(ge=10, le=2000)] = 250
    quality: Annotated[int, Field(ge=1, le=80)] = 10
    collision_quality: Annotated[int, Field(ge=1, le=20)] = 8


class Fall(Model):
    """Settings of every simulator, and how often a scene that fails a gate is drawn again."""

    max_attempts: Annotated[int, Field(ge=1, le=50)] = 8
    rod: RodFall = RodFall()
    cloth: ClothFall = ClothFall()
