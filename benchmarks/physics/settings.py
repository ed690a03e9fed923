"""The settings of each contender that are compared, and the numbers of cables on which they are compared."""

from dataclasses import dataclass

from benchmarks.physics.contenders import Contender
from farm.spec.simulation import ClothFall, Fall, RodFall

COUNTS = (1, 2, 4, 8)
"""Numbers of cables that a picture may show."""

COMPARED_COUNT = 8
"""The number of cables for which simulators are compared."""

CROWDS = (16, 32)
"""More cables than a picture shows, for the rod solver's default alone, to tell how its cost grows."""

PUBLISHED_COUNTS = (4, 8)
"""Numbers of cables for the published set-up. It always drops eight; if fewer than four are shown, the rest are near
copies of each other, which tangle, and one fall takes up to 100 s."""

DEFAULT_SCENES = 6
"""Scenes that every setting plays, unless told otherwise."""


@dataclass(frozen=True, slots=True)
class Setting:
    """One row of the comparison.

    Attributes:
        contender: contender that lets the cables fall.
        name: the setting in a few characters; unique for its contender.
        fall: the settings of all simulators, of which the contender takes its own.
        is_default: whether it is the contender's default.
        most_scenes: number of scenes, the first ones, to which a slow setting is limited.
        counts: numbers of cables.
    """

    contender: Contender
    name: str
    fall: Fall
    is_default: bool = False
    most_scenes: int = 1000
    counts: tuple[int, ...] = COUNTS


def rod_settings() -> tuple[Setting, ...]:
    """The rod solver's settings: one thing varied at a time about the default."""
    default = RodFall()
    steps, radii = default.steps_per_s, default.segment_radii
    pairs = [(250, radii), (500, radii), (steps, radii), (2000, radii), (4000, radii)]
    pairs += [(steps, 2.5), (steps, 3.0)]
    return tuple(_rod(RodFall(steps_per_s=each, segment_radii=length), default) for each, length in pairs)


def cloth_settings() -> tuple[Setting, ...]:
    """The cloth's settings: qualities of the joined set-up, then the published set-up at Blender's own quality."""
    pairs = [(5, 4), (5, 8), (10, 4), (10, 8), (20, 4), (20, 8), (40, 8)]
    published = Setting(
        contender=Contender.CLOTH_PUBLISHED,
        name="q 5",
        fall=Fall(cloth=ClothFall(quality=5)),
        is_default=True,
        most_scenes=2,
        counts=PUBLISHED_COUNTS,
    )
    return (*(_cloth(quality, collisions) for quality, collisions in pairs), published)


def all_settings() -> tuple[Setting, ...]:
    """The settings of all contenders."""
    return rod_settings() + cloth_settings()


def _rod(fall: RodFall, default: RodFall) -> Setting:
    return Setting(
        contender=Contender.ROD,
        name=f"{fall.steps_per_s}/s {fall.segment_radii:g}r",
        fall=Fall(rod=fall),
        is_default=fall == default,
        counts=COUNTS + CROWDS if fall == default else COUNTS,
    )


def _cloth(quality: int, collision_quality: int) -> Setting:
    fall = ClothFall(quality=quality, collision_quality=collision_quality)
    return Setting(
        contender=Contender.CLOTH,
        name=f"q {quality} c {collision_quality}",
        fall=Fall(cloth=fall),
        is_default=fall == ClothFall(),
        most_scenes=3 if quality > 20 else 1000,
    )
