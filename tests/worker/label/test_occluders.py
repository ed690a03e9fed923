"""Sticks and pegs hide cables in the labels."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from farm.scene.clutter import Peg, StickKind
from farm.scene.picture_size import PictureSize
from farm.spec.category import Category
from farm.spec.rendering import CableDetail
from tests.worker.clutter.things import make_stick
from tests.worker.scenes import make_scene, tubular
from worker.camera.view import View
from worker.curves import Points
from worker.geometry import SettledGeometry
from worker.label.label import label_cables
from worker.label.occluders import hiding_pieces
from worker.simulate.shapes import CableShapes


def straight(first: tuple[float, float, float], last: tuple[float, float, float], nodes: int = 60) -> Points:
    """A straight line of points."""
    return np.linspace(first, last, nodes)


def settled(stick_height_m: float) -> CableShapes:
    """A cable along x on the floor, and a pipe across it at some height."""
    cable = straight((-0.1, 0.0, 0.001), (0.1, 0.0, 0.001))
    stick = straight((0.0, -0.05, stick_height_m), (0.0, 0.05, stick_height_m))
    return CableShapes(
        nodes_m=(cable,),
        radii_m=np.array([0.001]),
        lengths_m=np.array([0.2]),
        speeds_m_s=(np.zeros(60),),
        start_order=(0, 1),
        fall_s=0.0,
        steps=0,
        sticks_m=(stick,),
        stick_radii_m=np.array([0.004]),
    )


def labelled(shapes: CableShapes, category: Category = Category.CLOSE_CONCENTRATED) -> NDArray[np.bool_]:
    """The pixels in which a picture of the cable and the pipe shows the cable."""
    scene = make_scene(category).model_copy(update={"sticks": (make_stick(StickKind.PIPE, length_m=0.1),)})
    hiding = hiding_pieces(SettledGeometry(scene, shapes, CableDetail(), PictureSize.square(256)))
    pieces = [tubular(shapes.nodes_m[0], 0.001), *hiding]
    return label_cables(pieces, View(height_m=0.2, resolution=PictureSize.square(256)), 20).mask > 0


def test_a_stick_above_a_cable_cuts_its_label() -> None:
    """The label is cut over the stick's width and nowhere else."""
    seen = labelled(settled(stick_height_m=0.006))
    row = seen[127]
    hidden = np.flatnonzero(~row)
    width_px = 256 / (0.2 * 36 / 50) * 0.008 * 0.2 / (0.2 - 0.006)
    assert abs(len(hidden) - width_px) <= 2
    assert abs(hidden.mean() - 127.5) <= 1


def test_a_stick_below_a_cable_leaves_its_label_whole() -> None:
    """A cable that lies on the stick keeps its whole label."""
    assert labelled(settled(stick_height_m=-0.006))[127].all()


def test_no_stick_hides_anything_where_the_floor_is_not_seen() -> None:
    """In a picture without a floor the stick isn't rendered and hides nothing."""
    assert labelled(settled(stick_height_m=0.006), Category.FAR)[127].all()


def seen_beside_a_peg(*, peg_m: tuple[float, float], cable_y_m: float) -> NDArray[np.bool_]:
    """The pixels that show a cable along x at some distance from the picture's middle, beside a peg 40 mm high."""
    peg = Peg(x_m=peg_m[0], y_m=peg_m[1], diameter_m=0.01, height_m=0.04, colour=(9, 9, 9), pattern_seed=0)
    cable = straight((-0.1, cable_y_m, 0.001), (0.1, cable_y_m, 0.001))
    axis = straight((*peg_m, -0.005), (*peg_m, 0.04), 9)
    shapes = replace(settled(0.1), nodes_m=(cable,), sticks_m=(), pegs_m=(axis,), peg_radii_m=np.array([0.005]))
    scene = make_scene(Category.CLOSE_CONCENTRATED).model_copy(update={"pegs": (peg,)})
    hiding = hiding_pieces(SettledGeometry(scene, shapes, CableDetail(), PictureSize.square(256)))
    return (
        label_cables([tubular(cable, 0.001), *hiding], View(height_m=0.2, resolution=PictureSize.square(256)), 20).mask
        > 0
    )


def test_a_peg_hides_the_cable_behind_it() -> None:
    """A camera above the middle sees a peg lean outwards, over its width as seen at the height that hides the cable."""
    seen = seen_beside_a_peg(peg_m=(0.0, 0.02), cable_y_m=0.0265).any(axis=0)
    hidden = np.flatnonzero(~seen)
    # The line of sight to the cable passes the peg's outer side between the floor and its top.
    width_px = 256 / (0.2 * 36 / 50) * 0.01
    assert 0.9 * width_px < len(hidden) < 1.3 * width_px
    assert abs(hidden.mean() - 127.5) <= 1


def test_a_cable_before_a_peg_is_seen_whole() -> None:
    """The same cable on the side towards the middle hides the peg's foot."""
    assert seen_beside_a_peg(peg_m=(0.0, 0.02), cable_y_m=0.0135).any(axis=0).all()


def test_a_peg_below_the_camera_hides_its_width_at_the_top() -> None:
    """Seen along its axis, a peg is a disc with the width of its top."""
    hidden = np.flatnonzero(~seen_beside_a_peg(peg_m=(0.0, 0.0), cable_y_m=0.0).any(axis=0))
    width_px = 256 / (0.2 * 36 / 50) * 0.01 * 0.2 / (0.2 - 0.04)
    assert abs(len(hidden) - width_px) <= 3
