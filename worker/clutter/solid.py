"""Meshes of small solid things: turned on a lathe, or cut from boxes and prisms. Pure numpy. Metres."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SIDES = 48
"""Sides of the ring that stands for a circle in what is turned on a lathe."""


@dataclass(frozen=True, slots=True)
class Finish:
    """What a surface is made of.

    Attributes:
        colour: sRGB levels.
        roughness: 0.1 is polished, 0.8 matt.
        metallic: 1 for bare metal, else 0.
        coat: weight of a clear lacquer.
        mottle: how much the colour varies from place to place, as a share.
        grain_m: over which length it does.
        streaks: how many times longer the variation is along the thing than around it.
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
        vertices_m: (V, 3).
        corners: (loops,) vertex of each face corner, faces one after the other.
        sizes: (faces,) how many corners each face has.
        finishes: (faces,) which of the thing's finishes each face has.
        smooth: (faces,) whether it is shaded as a part of something round.
    """

    vertices_m: Array
    corners: NDArray[np.int64]
    sizes: NDArray[np.int64]
    finishes: NDArray[np.int64]
    smooth: NDArray[np.bool_]

    def moved(self, by_m: Sequence[float] | Array) -> "Solid":
        """The same elsewhere."""
        return replace(self, vertices_m=self.vertices_m + np.asarray(by_m, dtype=np.float64))

    def turned(self, rotation: Array) -> "Solid":
        """The same, each vertex multiplied by a matrix (3, 3)."""
        return replace(self, vertices_m=self.vertices_m @ rotation.T)


def joined(solids: Sequence[Solid]) -> Solid:
    """Several as one."""
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
    """A stretch of what is turned on a lathe: smooth within, with an edge where the next one begins.

    Attributes:
        along_m: (N,) or (N, sides) places along the axis.
        radius_m: (N,) or (N, sides) distance from the axis there.
        finish: number of its finish.
        flat: (N,) factors of the height, which make a round thing flat; None: round.
        rippled: a thread or ribs, too fine for an outline, which is straight there.
    """

    along_m: Array
    radius_m: Array
    finish: int
    flat: Array | None = None
    rippled: bool = False


def section(profile: Sequence[tuple[float, float]], finish: int) -> Section:
    """A round section through points (along, radius)."""
    points = np.array(profile, dtype=np.float64)
    return Section(points[:, 0], points[:, 1], finish)


def turned_on_lathe(sections: Sequence[Section], sides: int) -> Solid:
    """Turn sections about the x axis.

    Each section has vertices of its own, so that its edges are sharp. Walk with the matter on the right, from the
    start's middle to the end's, so that faces look outwards.
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
    """A convex outline (N, 2), anticlockwise, drawn up from `bottom_m` to `top_m`, with bevelled edges."""
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
    """A box between two corners, with bevelled edges."""
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
    """A regular polygon (corners, 2) about the origin, by the radius of the circle in it."""
    angle = 2 * np.pi * (np.arange(corners) + 0.5) / corners
    corners_m: Array = inscribed_radius_m / np.cos(np.pi / corners) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return corners_m


def inset(outline_m: Array, by_m: float) -> Array:
    """A convex outline (N, 2), anticlockwise, with all its edges moved inwards."""
    edge = np.roll(outline_m, -1, axis=0) - outline_m
    edge /= np.linalg.norm(edge, axis=1, keepdims=True)
    before = np.roll(edge, 1, axis=0)
    normal, normal_before = (np.stack([-each[:, 1], each[:, 0]], axis=1) for each in (edge, before))
    bisector = normal + normal_before
    moved: Array = outline_m + by_m * 2 * bisector / np.sum(bisector**2, axis=1, keepdims=True)
    return moved


def strap(curve_m: Array, width_m: float, thickness_m: float, finish: int) -> Solid:
    """A band on edge or flat: a rectangle swept along a level curve (N, 3), `width_m` high and `thickness_m` across."""
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
