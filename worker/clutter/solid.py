"""Meshes of small solids: turned on a lathe, or put together from boxes and prisms. Pure numpy, in metres."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SIDES = 48
"""Sides of the ring that stands for a circle in what is turned on a lathe."""


@dataclass(frozen=True, slots=True)
class Finish:
    """The material of a surface.

    Attributes:
        colour: sRGB levels.
        roughness: roughness, 0 to 1: 0.1 is polished, 0.8 matt.
        metallic: metalness, 0 to 1: 1 is bare metal, 0 is no metal.
        coat: weight of a clear lacquer, 0 to 1.
        mottle: variation of the colour from place to place, as a share of it.
        grain_m: length over which the colour varies, in metres.
        streaks: length of the variation along the object, as a multiple of that around it.
    """

    colour: tuple[int, int, int]
    roughness: float
    metallic: float = 0.0
    coat: float = 0.0
    mottle: float = 0.1
    grain_m: float = 0.004
    streaks: float = 1.0


@dataclass(frozen=True, slots=True)
class Solid:
    """A mesh of polygons.

    Attributes:
        vertices_m: (V, 3) metres.
        corners: (loops,) number of the vertex at each corner, face after face.
        sizes: (faces,) number of corners of each face.
        finishes: (faces,) number of each face's finish among those of the object.
        smooth: (faces,) whether a face is shaded as part of something round.
    """

    vertices_m: Array
    corners: NDArray[np.int64]
    sizes: NDArray[np.int64]
    finishes: NDArray[np.int64]
    smooth: NDArray[np.bool_]

    def moved(self, by_m: Sequence[float] | Array) -> "Solid":
        """Move the solid by a vector (3,) in metres."""
        return replace(self, vertices_m=self.vertices_m + np.asarray(by_m, dtype=np.float64))

    def turned(self, rotation: Array) -> "Solid":
        """Multiply each vertex by a matrix (3, 3)."""
        return replace(self, vertices_m=self.vertices_m @ rotation.T)


def joined(solids: Sequence[Solid]) -> Solid:
    """Join solids to one."""
    offsets = np.cumsum([0, *(len(solid.vertices_m) for solid in solids)])[:-1]
    return Solid(
        vertices_m=np.concatenate([solid.vertices_m for solid in solids]),
        corners=np.concatenate([solid.corners + offset for solid, offset in zip(solids, offsets, strict=True)]),
        sizes=np.concatenate([solid.sizes for solid in solids]),
        finishes=np.concatenate([solid.finishes for solid in solids]),
        smooth=np.concatenate([solid.smooth for solid in solids]),
    )


@dataclass(frozen=True, slots=True)
class Section:
    """A part of an object that is turned on a lathe: it is smooth, and an edge divides it from the next one.

    Attributes:
        along_m: (N,) or (N, sides) places along the axis, in metres.
        radius_m: (N,) or (N, sides) distance from the axis at these places, in metres.
        finish: number of the finish among those of the object.
        flat: (N,) factors of the height, which flatten a round object; None leaves it round.
        rippled: whether it is a thread or has ribs; an outline takes their mean radius.
    """

    along_m: Array
    radius_m: Array
    finish: int
    flat: Array | None = None
    rippled: bool = False


def section(profile: Sequence[tuple[float, float]], finish: int) -> Section:
    """Make a round section.

    Args:
        profile: points (place along the axis, radius), in metres.
        finish: number of the finish.
    """
    points = np.array(profile, dtype=np.float64)
    return Section(points[:, 0], points[:, 1], finish)


def turned_on_lathe(sections: Sequence[Section], sides: int) -> Solid:
    """Turn sections about the x axis.

    Each section has its own vertices, so that the edges between sections are sharp. The profile runs from the middle of
    the start to the middle of the end, with the material on its right, so that faces look outwards.

    Args:
        sections: sections, from the start to the end.
        sides: number of sides of the polygon that stands for a circle.
    """
    return joined([_turn(each, sides) for each in sections])


def _turn(each: Section, sides: int) -> Solid:
    angle = 2 * np.pi * np.arange(sides) / sides
    along = np.broadcast_to(each.along_m.reshape(len(each.along_m), -1), (len(each.along_m), sides))
    radius = np.broadcast_to(each.radius_m.reshape(len(each.radius_m), -1), along.shape)
    flat = np.ones(len(along)) if each.flat is None else each.flat
    vertices = np.stack([along, radius * np.cos(angle), flat[:, None] * radius * np.sin(angle)], axis=2)
    ring, side = np.meshgrid(np.arange(len(along) - 1), np.arange(sides), indexing="ij")
    ring, side = ring[..., None] + np.array([0, 0, 1, 1]), side[..., None] + np.array([0, 1, 1, 0])
    faces = ring.shape[0] * sides
    return Solid(
        vertices_m=vertices.reshape(-1, 3),
        corners=(ring * sides + side % sides).reshape(-1).astype(np.int64),
        sizes=np.full(faces, 4),
        finishes=np.full(faces, each.finish),
        smooth=np.ones(faces, np.bool_),
    )


def prism(outline_m: Array, bottom_m: float, top_m: float, bevel_m: float, finish: int) -> Solid:
    """Extrude a convex outline, with bevelled edges.

    Args:
        outline_m: (N, 2) metres, anticlockwise.
        bottom_m: height of the underside, in metres.
        top_m: height of the upper side, in metres.
        bevel_m: width of the bevels, in metres.
        finish: number of the finish.
    """
    count = len(outline_m)
    inner = inset(outline_m, bevel_m)
    levels = (
        (inner, bottom_m),
        (outline_m, bottom_m + bevel_m),
        (outline_m, top_m - bevel_m),
        (inner, top_m),
    )
    rings = [np.column_stack([outline, np.full(count, z)]) for outline, z in levels]
    here = np.arange(count)
    there = (here + 1) % count
    walls = [
        np.stack([k * count + here, k * count + there, (k + 1) * count + there, (k + 1) * count + here], axis=1)
        for k in range(len(rings) - 1)
    ]
    quads = np.concatenate(walls)
    return Solid(
        vertices_m=np.concatenate(rings),
        corners=np.concatenate([quads.reshape(-1), here[::-1], 3 * count + here]),
        sizes=np.concatenate([np.full(len(quads), 4), [count, count]]),
        finishes=np.full(len(quads) + 2, finish),
        smooth=np.zeros(len(quads) + 2, np.bool_),
    )


def box(low_m: Sequence[float], high_m: Sequence[float], bevel_m: float, finish: int) -> Solid:
    """Build a box with bevelled edges.

    Args:
        low_m: (3,) lowest coordinates, in metres.
        high_m: (3,) highest coordinates, in metres.
        bevel_m: width of the bevels, in metres; at most 0.4 of the shortest edge.
        finish: number of the finish.
    """
    (x0, y0, z0), (x1, y1, z1) = low_m, high_m
    bevel = min(bevel_m, 0.4 * min(x1 - x0, y1 - y0, z1 - z0))
    outline = np.array(
        [
            (x0 + bevel, y0),
            (x1 - bevel, y0),
            (x1, y0 + bevel),
            (x1, y1 - bevel),
            (x1 - bevel, y1),
            (x0 + bevel, y1),
            (x0, y1 - bevel),
            (x0, y0 + bevel),
        ]
    )
    return prism(outline, z0, z1, bevel, finish)


def polygon(corners: int, inscribed_radius_m: float) -> Array:
    """Make a regular polygon (corners, 2) about the origin, in metres, from the radius of the circle inside it."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5) / corners
    corners_m: Array = inscribed_radius_m / np.cos(np.pi / corners) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return corners_m


def inset(outline_m: Array, by_m: float) -> Array:
    """Move all edges of a convex, anticlockwise outline (N, 2) inwards by `by_m`, both in metres."""
    edge = np.roll(outline_m, -1, axis=0) - outline_m
    edge /= np.linalg.norm(edge, axis=1, keepdims=True)
    before = np.roll(edge, 1, axis=0)
    normal, normal_before = (np.stack([-each[:, 1], each[:, 0]], axis=1) for each in (edge, before))
    bisector = normal + normal_before
    moved: Array = outline_m + by_m * 2 * bisector / np.sum(bisector**2, axis=1, keepdims=True)
    return moved


def strap(curve_m: Array, width_m: float, thickness_m: float, finish: int) -> Solid:
    """Sweep a rectangle with bevelled corners along a level curve.

    Args:
        curve_m: (N, 3) metres, level.
        width_m: height of the band, in metres.
        thickness_m: thickness across the curve, in metres.
        finish: number of the finish.
    """
    along = np.gradient(curve_m, axis=0)
    across = np.cross(along, [0.0, 0.0, 1.0])
    across *= thickness_m / 2 / np.linalg.norm(across, axis=1, keepdims=True)
    up = np.array([0.0, 0.0, width_m / 2])
    bevel = 0.8
    ring = ((1, bevel), (bevel, 1), (-bevel, 1), (-1, bevel), (-1, -bevel), (-bevel, -1), (bevel, -1), (1, -bevel))
    vertices = np.stack([curve_m + side * across + level * up for side, level in ring], axis=1)
    count, corners = len(curve_m), len(ring)
    step, turn = np.meshgrid(np.arange(count - 1), np.arange(corners), indexing="ij")
    step, turn = step[..., None] + np.array([0, 1, 1, 0]), turn[..., None] + np.array([0, 0, 1, 1])
    quads = (step * corners + turn % corners).reshape(-1)
    ends = np.concatenate([np.arange(corners), (count - 1) * corners + np.arange(corners)[::-1]])
    faces = (count - 1) * corners
    return Solid(
        vertices_m=vertices.reshape(-1, 3),
        corners=np.concatenate([quads, ends]).astype(np.int64),
        sizes=np.concatenate([np.full(faces, 4), [corners, corners]]),
        finishes=np.full(faces + 2, finish),
        smooth=np.zeros(faces + 2, np.bool_),
    )
