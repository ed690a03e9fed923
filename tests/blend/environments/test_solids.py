"""Simple solids."""

import numpy as np
import pytest

from blend.environments.assembly import Assembly
from blend.environments.solids import Solid, hanging, swept, turned

GREY = (0.5, 0.5, 0.5)


def solid_of(assembly: Assembly) -> Solid:
    """The solid that was placed, of the only material there is."""
    (parts,) = assembly.parts.values()
    points = np.concatenate([part.points for part in parts])
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    faces = tuple(face + start for part, start in zip(parts, starts, strict=False) for face in part.faces)
    return Solid(points, faces)


def volume(solid: Solid) -> float:
    """Volume of a closed solid whose faces look outwards, as a sum of tetrahedra about the origin."""
    total = 0.0
    for faces in solid.faces:
        corners = solid.points[faces]
        for n in range(1, faces.shape[1] - 1):
            total += float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, n], corners[:, n + 1])).sum()) / 6
    return total


def assembly() -> Assembly:
    """An empty assembly."""
    return Assembly(np.random.default_rng(0))


@pytest.mark.parametrize("bevel", [0.0, 0.01])
def test_a_box_is_closed_and_looks_outwards(bevel: float) -> None:
    """The volume within its faces is the product of its edges, less the chamfers."""
    a = assembly()
    a.box((1.0, 2.0, 3.0), (0.4, 0.3, 0.2), "paint", GREY, bevel=bevel)
    solid = solid_of(a)
    assert volume(solid) == pytest.approx(0.024, rel=1e-9 if bevel == 0 else 0.02)
    assert solid.points.min(axis=0) == pytest.approx([0.8, 1.85, 3.0])
    assert solid.points.max(axis=0) == pytest.approx([1.2, 2.15, 3.2])


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_a_cylinder_is_closed_and_looks_outwards(axis: str) -> None:
    """The volume is that of a prism with the same number of sides."""
    a = assembly()
    a.cylinder((0.1, 0.2, 0.3), 0.5, 2.0, "paint", GREY, axis=axis, sides=12)
    assert volume(solid_of(a)) == pytest.approx(0.5 * 12 * 0.25 * np.sin(np.pi / 6) * 2.0)


def test_a_prism_is_closed_and_looks_outwards() -> None:
    """The volume is the outline's area times its width."""
    a = assembly()
    a.prism([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], 2.0, 0.5, "paint", GREY)
    assert volume(solid_of(a)) == pytest.approx(0.25)


def test_a_tube_keeps_its_radius_round_a_corner() -> None:
    """Every point of a ring is a radius away from the line."""
    line = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)], np.float64)
    rings = swept(line, 0.1).points.reshape(4, -1, 3)
    assert np.linalg.norm(rings - line[:, None], axis=2) == pytest.approx(0.1)


def test_a_hanging_cable_sags_in_its_middle() -> None:
    """A cable sags by the given amount and ends at its ends."""
    points = hanging((0, 0, 2), (4, 0, 2), 0.5)
    assert points[[0, -1]] == pytest.approx(np.array([(0, 0, 2), (4, 0, 2)]))
    assert points[:, 2].min() == pytest.approx(1.5)


def test_frames_nest() -> None:
    """A thing that is placed within a turned one turns with it."""
    a = assembly()
    with a.at(1.0, 0.0, turn=90), a.at(0.0, 2.0):
        assert a.frame[:3, 3] == pytest.approx([-1.0, 0.0, 0.0])
    assert a.frame == pytest.approx(np.eye(4))
    assert a.things == 2


def test_a_lean_tips_forwards_about_x() -> None:
    """A positive lean takes the top towards -y."""
    assert turned(0, 0, 0, 0, 90)[:3, :3] @ [0, 0, 1] == pytest.approx([0, -1, 0])


def test_a_picture_is_read_from_the_front() -> None:
    """Seen from +y, the left edge lies at +x and shows the left of the atlas's cell."""
    a = assembly()
    a.picture((0.0, 0.0, 0.0), (1.0, 1.0), (0.1, 0.2, 0.3, 0.4))
    (part,) = a.parts["print"]
    assert part.uv is not None
    left = part.points[:, 0] > 0
    assert set(part.uv[left, 0]) == {0.1}
    assert set(part.uv[~left, 0]) == {0.3}
    corners = part.points[part.faces[0][0]]
    assert np.cross(corners[1] - corners[0], corners[2] - corners[1])[1] > 0


def test_walls_keep_their_courses_level() -> None:
    """Bricks lie level even on a pier that is higher than wide."""
    a = assembly()
    a.box((0.0, 0.0, 0.0), (0.3, 0.2, 3.0), "brick", GREY)
    (part,) = a.parts["brick"]
    assert np.ptp(part.local, axis=0) == pytest.approx([0.3, 3.0, 0.2])
