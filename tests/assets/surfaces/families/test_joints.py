"""Maps of joints: their storage, and the joints of each surface."""

import numpy as np
import pytest

from assets.surfaces.catalogue import SURFACES
from assets.surfaces.kit.maps import JOINT_REACH_MM, joint_distance_mm, joint_levels
from assets.surfaces.recipe import SurfaceFamily
from tests.assets.built import built, steps

JOINTED = (
    *("oak_planks", "walnut_planks", "cherry_planks", "pine_boards", "oak_herringbone", "walnut_herringbone"),
    *("grey_laminate", "birch_veneer", "weathered_boards", "oak_chevron", "melamine_board"),
    *("ceramic_white", "slate_tiles", "terracotta_tiles", "glass_mosaic", "checker_tiles", "hexagon_tiles"),
    *("travertine_tiles", "marble_tiles_green", "cement_patterned"),
    *("brick_wall", "brick_paving", "paving_slabs", "cobble"),
)


def test_distances_come_back_to_half_a_level() -> None:
    """Distances come back within the reach; a larger one comes back as the reach."""
    distance = np.linspace(-1.5 * JOINT_REACH_MM, 1.5 * JOINT_REACH_MM, 500, dtype=np.float32)[None]
    found = joint_distance_mm(joint_levels(distance))
    step = JOINT_REACH_MM / 127.5
    assert np.abs(found - np.clip(distance, -JOINT_REACH_MM, JOINT_REACH_MM)).max() <= 0.51 * step


@pytest.mark.parametrize("name", JOINTED)
def test_what_is_laid_in_pieces_has_joints(name: str) -> None:
    """Planks, tiles, bricks, slabs and stones."""
    assert built(name).joints is not None


WHOLE = (SurfaceFamily.GROUND, SurfaceFamily.FABRIC, SurfaceFamily.PLASTER, SurfaceFamily.CONCRETE, SurfaceFamily.METAL)


@pytest.mark.parametrize("name", [name for name, recipe in SURFACES.items() if recipe.family in WHOLE])
def test_what_is_of_one_piece_has_no_joints(name: str) -> None:
    """Ground, cloth, plaster, concrete and metal."""
    assert built(name).joints is None


@pytest.mark.parametrize(
    ("name", "share"),
    [
        # Bricks of 190 by 56.67 mm in fields of 200 by 66.67; slabs and tiles in square fields, less a joint.
        ("brick_wall", 1 - 190 * 56.67 / (200 * 66.67)),
        ("paving_slabs", 1 - (250 - 4.5) * (250 - 4.5) / 250**2),
        ("cement_patterned", 1 - (133.33 - 1.4) ** 2 / 133.33**2),
    ],
)
def test_joints_take_the_share_of_the_area_that_their_width_gives(name: str, share: float) -> None:
    """Joints take that share to a fifth of it, as edges wander and corners are worn."""
    joints = built(name).joints
    assert joints is not None
    assert np.mean(joint_distance_mm(joints) < 0) == pytest.approx(share, rel=0.2)


@pytest.mark.parametrize("name", ["oak_planks", "ceramic_white", "weathered_boards", "brick_paving", "cobble"])
def test_joints_lie_where_the_surface_shows_them(name: str) -> None:
    """At a joint the colour differs from that of the pieces beside it."""
    maps = built(name)
    assert maps.joints is not None
    distance = joint_distance_mm(maps.joints)
    grey = maps.colour.mean(axis=2)
    inside, beside = grey[distance < 0], grey[distance > 1.0]
    assert abs(inside.mean() - beside.mean()) > 0.5 * beside.std()


@pytest.mark.parametrize("name", JOINTED)
@pytest.mark.parametrize("axis", [0, 1])
def test_joints_meet_at_opposite_edges(name: str, axis: int) -> None:
    """The map of joints tiles like the other maps."""
    joints = built(name).joints
    assert joints is not None
    seam, *inside = steps(joints, axis)
    assert seam <= 1.1 * max(inside) + 0.5
