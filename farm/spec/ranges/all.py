"""All ranges of random parameters together, with the published ones as defaults.

Source: Malvido Fresnillo et al., "Generation of realistic synthetic cable images to train deep learning
segmentation models", Machine Vision and Applications 35(4), 2024, doi 10.1007/s00138-024-01562-y.

Lengths are in metres of the picture, in which cables have their true size (2.4 mm thick); angles are in degrees. The
wind's numbers are those of a Blender wind field in the fall's own units (docs/design/solver.md, "Two scales"). Where
the publication gives no figure (cable length, drop height, spacing, f-number) the default is ours, and the docstring
says so.
"""

from typing import Self

from pydantic import model_validator

from farm.model import Model
from farm.scene.camera import FOCAL_LENGTH_MM, SENSOR_MM
from farm.spec.ranges.backdrop import PlateRanges, WorldRanges
from farm.spec.ranges.cable import CableRanges
from farm.spec.ranges.camera import CameraRanges, DevelopmentRanges
from farm.spec.ranges.clutter import ClutterRanges
from farm.spec.ranges.floor import FloorRanges
from farm.spec.ranges.light import LampRanges, StudioRanges
from farm.spec.ranges.placement import PlacementRanges, WindRanges

_DEEPEST_PILE = 8
"""Cables of a pile, one on the other, beyond which more cables make it wider, not higher: in the wide style the highest
of 64 piles of 8 to 24 cables reached 0.39 of the camera's height."""


class Ranges(Model):
    """The ranges of all random parameters, by the part of the scene that they belong to."""

    floor: FloorRanges = FloorRanges()
    wind: WindRanges = WindRanges()
    placement: PlacementRanges = PlacementRanges()
    cable: CableRanges = CableRanges()
    clutter: ClutterRanges = ClutterRanges()
    lamp: LampRanges = LampRanges()
    studio: StudioRanges = StudioRanges()
    world: WorldRanges = WorldRanges()
    plate: PlateRanges = PlateRanges()
    camera: CameraRanges = CameraRanges()
    development: DevelopmentRanges = DevelopmentRanges()

    @model_validator(mode="after")
    def _fit_each_other(self) -> Self:
        lowest = min(self.camera.heights_m)
        pile = min(self.cable.count[1], _DEEPEST_PILE) * self.cable.diameters_m(seen_width_m(lowest))[1]
        if lowest < 2 * pile:
            raise ValueError(
                f"camera.heights_m {lowest} is below twice the highest pile, {pile:g} m "
                "(cable.count times the thickest cable): the camera would be among the cables"
            )
        return self


def seen_width_m(height_m: float) -> float:
    """Compute the length of the floor, in metres, that a lens of `FOCAL_LENGTH_MM` sees from a height in metres.

    It is that along the picture's longer edge.
    """
    return height_m * SENSOR_MM / FOCAL_LENGTH_MM
