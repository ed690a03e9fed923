"""A settled scene's geometry is derived once, and is that of the scene."""

from dataclasses import replace

import numpy as np
import pytest

from farm.scene.clutter import PartKind, StickKind
from farm.scene.picture_size import PictureSize
from farm.spec.category import Category
from farm.spec.rendering import CableDetail
from tests.worker.clutter.things import make_part, make_stick
from tests.worker.scenes import make_scene
from tests.worker.settled import rod, shapes
from worker.cable.piece import Tubular
from worker.geometry import SettledGeometry

RESOLUTION = PictureSize.square(64)


def geometry(detail: CableDetail | None = None, distortion: float = 0.0, *, sticks: int = 0) -> SettledGeometry:
    """Two crossing cables under a camera; and two drawn sticks, of which some fell."""
    drawn = make_scene(Category.CLOSE_CONCENTRATED)
    scene = drawn.model_copy(
        update={
            "cables": (drawn.cables[0], drawn.cables[0]),
            "sticks": (make_stick(StickKind.PIPE), make_stick(StickKind.PIPE)),
            "parts": (make_part(PartKind.WASHER, x_m=0.0, y_m=0.0), make_part(PartKind.WASHER, x_m=0.05, y_m=0.05)),
            "camera": drawn.camera.model_copy(update={"distortion": distortion}),
        }
    )
    settled = shapes(rod(), rod(along_y=True, z=0.003))
    fallen = replace(settled, sticks_m=tuple(rod(y=0.05) for _ in range(sticks)), stick_radii_m=np.full(sticks, 0.004))
    return SettledGeometry(scene, fallen, detail or CableDetail(), RESOLUTION)


@pytest.mark.parametrize("part", ["curves", "pieces", "sticks", "parts", "view", "rendered_view"])
def test_each_part_is_derived_once(part: str) -> None:
    """Asked twice, it gives the very same object."""
    settled = geometry()
    assert getattr(settled, part) is getattr(settled, part)


def test_curves_are_as_fine_as_the_detail_asks() -> None:
    """Points for each segment of the fall, and the last node."""
    curves = geometry(CableDetail(points_per_segment=3)).curves
    assert [curve.shape for curve in curves] == [(3 * 40 + 1, 3)] * 2


def test_pieces_lie_on_the_curves() -> None:
    """A plain cable is one piece, whose curve is its own."""
    settled = geometry()
    sheaths = [piece for piece in settled.pieces if isinstance(piece, Tubular)]
    assert all(np.array_equal(piece.curve, curve) for piece, curve in zip(sheaths, settled.curves, strict=True))


@pytest.mark.parametrize("fell", [0, 1, 2])
def test_only_sticks_that_fell_are_there(fell: int) -> None:
    """A simulator without sticks leaves the drawn ones out."""
    assert len(geometry(sticks=fell).sticks) == fell


def test_a_part_below_a_cable_is_left_out() -> None:
    """The other one has room."""
    assert [part.x_m for part in geometry().parts] == [0.05]


def test_a_part_below_a_stick_is_left_out() -> None:
    """A stick along y = 0.05 takes the other's place."""
    assert geometry(sticks=1).parts == ()


def test_labels_see_the_distortion_and_blender_does_not() -> None:
    """Both look from the same place, at the picture's resolution."""
    settled = geometry(distortion=-0.1)
    assert (settled.view.distortion, settled.rendered_view.distortion) == (-0.1, 0.0)
    assert settled.view.resolution == settled.rendered_view.resolution == RESOLUTION
    assert np.array_equal(settled.view.position_m, settled.rendered_view.position_m)
