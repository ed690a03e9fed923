"""Faces set in joints: grout, worn edges and dirt, which all tiled floors share."""

from dataclasses import dataclass

import numpy as np

from assets.surfaces.kit.colour import mix, ramp, shade, value_each
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.layouts import Layout
from assets.surfaces.kit.marks import dust
from assets.surfaces.kit.noise import fractal, smoothstep


@dataclass(frozen=True)
class Joints:
    """The joints in which tiles are set.

    Attributes:
        width_mm: Width of the joint between two tiles.
        depth_mm: Depth of the grout below the faces.
        stops: Colour ramp of the grout: values 0 to 1, and hexadecimal sRGB colours.
        round_mm: Distance that a tile's rounded edge reaches into its face.
        wander_mm: Standard deviation of the edges' unevenness.
        tilt: Largest slope, along each axis, of a tile that wasn't laid level.
        grime: Strength of the dirt along the joints.
    """

    width_mm: float = 3.0
    depth_mm: float = 0.8
    stops: tuple[tuple[float, str], ...] = ((0.0, "7d786f"), (1.0, "aaa499"))
    round_mm: float = 1.2
    wander_mm: float = 0.1
    tilt: float = 0.002
    grime: float = 0.25


@dataclass(frozen=True)
class Face:
    """The look of the tiles themselves, drawn over the whole grid.

    Attributes:
        colour: sRGB 0 to 1, shape (H, W, 3).
        roughness: 0 mirror-like to 1 matt, shape (H, W).
        height_mm: Relief of the faces, shape (H, W).
    """

    colour: Field
    roughness: Field
    height_mm: Field


@dataclass(frozen=True)
class SetFaces(Face):
    """A floor of faces set in joints.

    Attributes:
        to_joint_mm: Distance to the nearest edge of a joint, negative inside it, shape (H, W).
    """

    to_joint_mm: Field


def set_tiles(rng: np.random.Generator, grid: Grid, layout: Layout, face: Face, joints: Joints) -> SetFaces:
    """Set faces in joints.

    Args:
        rng: Source of the randomness.
        grid: The tile of texels.
        layout: Layout of the ceramic or stone tiles.
        face: Look of the tiles.
        joints: Joints between the tiles.

    Returns:
        Colour, roughness and height of the floor, and the distance to its joints.
    """
    edge = layout.edge_mm + joints.wander_mm * fractal(rng, grid, 30, 1.4, gain=0.5) - 0.5 * joints.width_mm
    inside = smoothstep(-0.12, 0.18, edge)
    shoulder = np.sqrt(np.clip(1 - np.square(1 - np.clip(edge / joints.round_mm, 0, 1)), 0, 1))
    sand = fractal(rng, grid, 1.6, 0.0, gain=0.8)
    tone = 0.5 + 0.14 * sand + 0.2 * fractal(rng, grid, 45, 1.5, gain=0.65)
    grout = shade(ramp(tone, joints.stops), 0.8 + 0.2 * smoothstep(-0.5 * joints.width_mm, -0.2, -edge))
    grime = joints.grime * dust(rng, grid, 1 - smoothstep(0.0, 5.0, edge))
    colour = mix(shade(face.colour, 0.86 + 0.14 * shoulder), "5a5044", grime)
    colour = mix(grout, colour, inside)
    tilt_u = value_each(rng, layout.labels, -joints.tilt, joints.tilt)
    tilt_v = value_each(rng, layout.labels, -joints.tilt, joints.tilt)
    lie = tilt_u * layout.u_mm + tilt_v * layout.v_mm
    top = face.height_mm + lie + 0.55 * joints.depth_mm * (shoulder - 1)
    bottom = -joints.depth_mm + 0.05 * sand
    height = bottom + (top - bottom) * inside
    rough = 0.9 + (face.roughness + 0.4 * grime - 0.9) * inside
    return SetFaces(colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), edge)
