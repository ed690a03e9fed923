"""A settled scene's geometry, derived once for a picture and read by building, matting and labelling. Pure numpy.

It joins parts from the rooms of cables, clutter, camera and fall, so it stands beside those rooms and not in one of
them: the fall, for example, must not know the camera. Each part is computed at its first use, and then kept.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from farm.scene.clutter import Part, Peg, Stick
from farm.scene.picture_size import PictureSize
from farm.scene.scene import Scene
from farm.spec.rendering import CableDetail
from worker.cable.piece import Piece
from worker.cable.pieces import pieces_of
from worker.camera.lens import lens_radius_m
from worker.camera.view import View
from worker.clutter.fit import parts_that_fit
from worker.curves import Points, smooth
from worker.simulate.shapes import CableShapes


@dataclass(frozen=True, eq=False)
class SettledGeometry:
    """The geometry of one picture: its settled cables, sticks and small parts, and its camera.

    Attributes:
        scene: the scene as drawn.
        shapes: its settled cables and sticks.
        detail: fineness of the models of cables.
        resolution: size of the picture, in pixels.
    """

    scene: Scene
    shapes: CableShapes
    detail: CableDetail
    resolution: PictureSize

    @cached_property
    def curves(self) -> tuple[Points, ...]:
        """Each cable's centreline (N, 3) in metres, at the sampling that is rendered and labelled."""
        return tuple(smooth(nodes, self.detail.points_per_segment) for nodes in self.shapes.nodes_m)

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The cables in the pieces that are rendered and labelled; see `worker.cable.pieces.pieces_of`."""
        return tuple(pieces_of(self.scene, self.curves, self.shapes.sticks_m, self.shapes.pegs_m))

    @cached_property
    def sticks(self) -> tuple[tuple[Stick, Points], ...]:
        """The sticks that fell, each with the nodes (N, 3) of its axis in metres; none from a simulator without sticks.

        Drawn sticks beyond those that fell are left out.
        """
        return tuple(zip(self.scene.sticks[: len(self.shapes.sticks_m)], self.shapes.sticks_m, strict=True))

    @cached_property
    def pegs(self) -> tuple[tuple[Peg, Points], ...]:
        """The pegs, each with the nodes (N, 3) of its axis in metres; none from a simulator without pegs."""
        return tuple(zip(self.scene.pegs[: len(self.shapes.pegs_m)], self.shapes.pegs_m, strict=True))

    @cached_property
    def parts(self) -> tuple[Part, ...]:
        """The drawn small parts that have room between the settled cables, sticks and pegs."""
        diameters_m = [cable.diameter_m for cable in self.scene.cables] + [stick.diameter_m for stick, _ in self.sticks]
        diameters_m += [peg.diameter_m for peg, _ in self.pegs]
        lines = [*self.curves, *(axis for _, axis in self.sticks), *(axis for _, axis in self.pegs)]
        return parts_that_fit(self.scene.parts, lines, np.array(diameters_m) / 2, self.view.steepest_slope)

    @cached_property
    def view(self) -> View:
        """The camera through the middle of its lens, with the lens's distortion, for which labels are drawn."""
        return View.of(self.scene.camera, self.resolution)

    @cached_property
    def rendered_view(self) -> View:
        """The same camera without distortion, for which Blender renders."""
        return self.view.undistorted()

    @property
    def lens_radius_m(self) -> float:
        """Radius of the camera's aperture in metres."""
        return lens_radius_m(self.scene.camera)
