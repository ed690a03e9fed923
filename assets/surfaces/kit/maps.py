"""The maps that make up a finished surface, and how relief becomes normals and shadowed hollows."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.noise import blur, smoothstep


@dataclass(frozen=True)
class SurfaceMaps:
    """A surface as a renderer reads it; every map tiles without a seam.

    Attributes:
        colour: Base colour, shape (H, W, 3), sRGB, channels red green blue.
        roughness: Shape (H, W), linear, 0 mirror-like to 255 matt.
        normal: Tangent-space normals, shape (H, W, 3), OpenGL convention: green grows towards the top row.
        metallic: 0.0 to 1.0 for the whole surface, or a map of shape (H, W), 0 to 255, linear.
        joints: Distance of each texel from the nearest joint, shape (H, W), as `joint_levels` stores it; None for a
            surface without joints.
    """

    colour: npt.NDArray[np.uint8]
    roughness: npt.NDArray[np.uint8]
    normal: npt.NDArray[np.uint8]
    metallic: float | npt.NDArray[np.uint8]
    joints: npt.NDArray[np.uint8] | None = None


JOINT_REACH_MM = 3.0
"""Largest distance from a joint's edge, on either side, that a map of joints can hold, millimetres: 8 bits then tell
0.024 mm apart."""


def joint_levels(to_joint_mm: Field) -> npt.NDArray[np.uint8]:
    """Store distances from joints' edges.

    A distance, unlike a mask, stays exact when texels are averaged, and tells a wider joint from a narrow one.

    Args:
        to_joint_mm: Distance to the nearest edge of a joint in millimetres, negative inside it, shape (H, W).

    Returns:
        Shape (H, W): 255 deep inside, 127 or 128 at the edge, 0 from `JOINT_REACH_MM` on.
    """
    return _bytes(np.asarray(0.5 - to_joint_mm * np.float32(0.5 / JOINT_REACH_MM), np.float32))


def joint_distance_mm(levels: npt.NDArray[np.uint8]) -> Field:
    """Read back the distances that `joint_levels` stored, shape (H, W)."""
    return (127.5 - levels.astype(np.float32)) * np.float32(JOINT_REACH_MM / 127.5)


def finish(
    grid: Grid,
    colour: Field,
    roughness: Field | float,
    height_mm: Field,
    metallic: Field | float = 0.0,
    to_joint_mm: Field | None = None,
) -> SurfaceMaps:
    """Quantise a drawn surface.

    Args:
        grid: The grid on which it was drawn.
        colour: Shape (H, W, 3), sRGB 0 to 1; values outside are clipped.
        roughness: 0 to 1, a field or one value.
        height_mm: Relief in millimetres, shape (H, W).
        metallic: 0 to 1, one value, or a field of how far metal shows, whose middle values `_bare` makes narrow.
        to_joint_mm: Distance to the nearest edge of a joint, negative inside it, shape (H, W); None without joints.

    Returns:
        The maps, in 8 bits.
    """
    rough = np.broadcast_to(np.asarray(roughness, np.float32), height_mm.shape)
    return SurfaceMaps(
        colour=_bytes(colour),
        roughness=_bytes(rough),
        normal=normal_from_height(height_mm, grid),
        metallic=_bytes(_bare(metallic)) if isinstance(metallic, np.ndarray) else float(metallic),
        joints=None if to_joint_mm is None else joint_levels(to_joint_mm),
    )


def _bare(metal: Field) -> Field:
    """Narrow the border between bare metal and what covers it.

    No real material is half metal, and the renderer shades such a texel twice: an aluminium floor with a wide border
    took 1.18 times as long as a plain floor, and with this narrow one 1.02 times (`python -m benchmarks surfaces`).
    """
    return smoothstep(0.35, 0.65, metal)


def normal_from_height(height_mm: Field, grid: Grid) -> npt.NDArray[np.uint8]:
    """Turn relief into tangent-space normals, with the relief's true slope.

    Args:
        height_mm: Height in millimetres, shape (H, W), row 0 at the top.
        grid: Grid of the height, which gives the distance between texels.

    Returns:
        Shape (H, W, 3), OpenGL convention: red for x to the right, green for y towards the top row, blue out
        of the surface; 128 stands for 0.
    """
    scale = np.float32(0.5 / grid.texel_mm)
    right = (np.roll(height_mm, -1, 1) - np.roll(height_mm, 1, 1)) * scale
    down = (np.roll(height_mm, -1, 0) - np.roll(height_mm, 1, 0)) * scale
    inverse = 1.0 / np.sqrt(right * right + down * down + 1.0)
    normal = np.empty((*height_mm.shape, 3), np.uint8)
    normal[..., 0] = np.rint(127.5 - 127.5 * right * inverse)
    normal[..., 1] = np.rint(127.5 + 127.5 * down * inverse)
    normal[..., 2] = np.rint(127.5 + 127.5 * inverse)
    return normal


def hollows(height_mm: Field, radius_mm: float, depth_mm: float, grid: Grid) -> Field:
    """Find where a surface lies below its surroundings: where dirt gathers and light doesn't reach.

    Args:
        height_mm: Relief, shape (H, W).
        radius_mm: Standard deviation of the Gaussian that averages the surroundings.
        depth_mm: Depth below the surroundings that counts as a full hollow.
        grid: The tile.

    Returns:
        Shape (H, W): 0 where the surface is level or raised, 1 in a full hollow.
    """
    return smoothstep(0.0, depth_mm, blur(height_mm, radius_mm, grid) - height_mm)


def _bytes(field: Field) -> npt.NDArray[np.uint8]:
    return np.asarray(np.rint(np.clip(field, 0.0, 1.0) * 255.0), np.uint8)
