"""Many simple solids in few meshes: each solid has its own place, material and tint.

One mesh for each material renders faster than one object for each thing. What differs from solid to solid (its colour,
and the point where its grain begins) lies in the mesh's attributes `tint` and `local`, which the materials read.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from blend.environments.palette import Colour
from blend.environments.solids import CHAMFERED, CUBE, Solid, lathed, swept, turned

Points = NDArray[np.float64]
Print = tuple[float, float, float, float]
"""Rectangle of a picture in the atlas: left, bottom, right, top, each 0 to 1."""

COURSED = frozenset({"brick", "blocks", "ribbed", "tiles", "pegboard"})
"""Materials whose courses run level and continue from one solid to the next."""


@dataclass(frozen=True, slots=True)
class Part:
    """Faces of one material.

    Attributes:
        points: corners, (N, 3), metres in the world.
        faces: index arrays (M, K) of polygons with K corners.
        tint: linear colour, (N, 4), or the radiance of a solid that shines; the fourth number is random, one for each
            solid.
        local: position along the solid's own axes, the longest first, from a random origin, (N, 3), metres.
        smooth: whether the faces are shaded as if curved.
        uv: position in the atlas, (N, 2); None for a part that shows no picture.
    """

    points: Points
    faces: tuple[NDArray[np.int64], ...]
    tint: Points
    local: Points
    smooth: bool
    uv: Points | None = None


@dataclass(frozen=True, slots=True)
class Daylight:
    """An opening that lets light in: a one-sided lamp that can't be seen.

    Attributes:
        frame: matrix, (4, 4), from the opening's own frame (x across, z up, light towards +y) into the world.
        width_m: width of the opening.
        height_m: height of the opening.
    """

    frame: Points
    width_m: float
    height_m: float


@dataclass
class Assembly:
    """Collects solids, which are placed relative to the innermost `at`.

    Attributes:
        rng: source of all randomness in the environment.
        parts: parts collected so far, by material.
        daylight: openings that let daylight in.
        things: number of things placed; a thing may have many solids.
    """

    rng: np.random.Generator
    parts: dict[str, list[Part]] = field(default_factory=dict)
    daylight: list[Daylight] = field(default_factory=list)
    things: int = 0
    _frames: list[Points] = field(default_factory=lambda: [np.eye(4)])

    @property
    def frame(self) -> Points:
        """Matrix, (4, 4), from the innermost thing's own frame into the world."""
        return self._frames[-1]

    @contextmanager
    def at(self, x: float, y: float, z: float = 0.0, turn: float = 0.0, lean: float = 0.0) -> Iterator["Assembly"]:
        """Place a thing: solids added within the context lie in the thing's own frame.

        Args:
            x: x of the thing's origin in the enclosing frame, metres.
            y: y of the origin, metres.
            z: z of the origin, metres.
            turn: turn about the vertical, degrees.
            lean: lean about the thing's own x axis after the turn, degrees.
        """
        self._frames.append(self.frame @ turned(x, y, z, turn, lean))
        self.things += 1
        try:
            yield self
        finally:
            self._frames.pop()

    def box(
        self,
        place: tuple[float, float, float],
        size: tuple[float, float, float],
        material: str,
        tint: Colour,
        *,
        bevel: float = 0.0,
        turn: float = 0.0,
    ) -> None:
        """Add a box; `place` is the middle of its underside, `bevel` the width of its chamfers in metres."""
        edges = np.maximum(np.abs(np.array(size)), 1e-4)
        bevel = min(bevel, 0.3 * float(edges.min()))
        if bevel > 0:
            template, half = CHAMFERED, 0.5 * edges
            points = np.where(template.outer, half, half - bevel) * template.signs
        else:
            template, points = CUBE, CUBE.signs * 0.5 * edges
        middle = (place[0], place[1], place[2] + 0.5 * edges[2])
        frame = turned(*middle, turn) if turn else None
        self._add(Solid(points, template.faces), material, tint, offset=middle, frame=frame)

    def cylinder(
        self,
        place: tuple[float, float, float],
        radius: float,
        length: float,
        material: str,
        tint: Colour,
        *,
        axis: str = "z",
        top: float | None = None,
        sides: int = 14,
    ) -> None:
        """Add a cylinder or cone; `place` is the middle of one end, `top` the radius of the other if it differs."""
        self.lathe(place, [(radius, 0.0), (radius if top is None else top, length)], material, tint, axis, sides)

    def lathe(
        self,
        place: tuple[float, float, float],
        profile: Sequence[tuple[float, float]],
        material: str,
        tint: Colour,
        axis: str = "z",
        sides: int = 16,
    ) -> None:
        """Add a body of revolution with closed ends.

        Args:
            place: point on the axis from which distances along it count.
            profile: radius and distance along the axis of each ring, metres.
            material: name of the material.
            tint: linear colour.
            axis: "x", "y" or "z".
            sides: number of sides of the polygon that stands for the circle.
        """
        for solid in lathed(profile, axis, sides):
            self._add(solid, material, tint, offset=place)

    def tube(
        self, points: Sequence[tuple[float, float, float]] | Points, radius: float, material: str, tint: Colour
    ) -> None:
        """Add a round tube along points (N, 3)."""
        self._add(swept(np.asarray(points, np.float64), radius), material, tint)

    def prism(
        self, outline: Sequence[tuple[float, float]], x: float, width: float, material: str, tint: Colour
    ) -> None:
        """Add a prism: an outline in (y, z), counter-clockwise seen from +x, made `width` thick about `x`."""
        flat = np.array(outline, np.float64)
        count = len(flat)
        left = np.column_stack([np.full(count, x - 0.5 * width), flat])
        points = np.vstack([left, left + np.array([width, 0.0, 0.0])])
        ring = np.arange(count)
        after = (ring + 1) % count
        sides = np.column_stack([ring, after, after + count, ring + count])
        faces = (sides, ring[None, ::-1], ring[None, :] + count)
        self._add(Solid(points, faces), material, tint)

    def quads(self, corners: Points, material: str, tints: Points) -> None:
        """Add loose four-cornered faces (N, 4, 3) with tints (N, 3)."""
        count = len(corners)
        points = self._placed(corners.reshape(-1, 3))
        seeds = self.rng.random(count)
        tint = np.repeat(np.column_stack([tints, seeds]), 4, axis=0)
        faces = (np.arange(4 * count).reshape(count, 4),)
        self.parts.setdefault(material, []).append(Part(points, faces, tint, points, smooth=False))

    def picture(
        self,
        place: tuple[float, float, float],
        size: tuple[float, float],
        shown: Print,
        material: str = "print",
        tint: Colour = (1.0, 1.0, 1.0),
        *,
        facing: str = "y",
    ) -> None:
        """Add a picture from the atlas.

        Args:
            place: middle of the picture's lower edge.
            size: width and height, metres.
            shown: rectangle of the picture in the atlas.
            material: name of a material that shows the atlas.
            tint: factor for the picture's colours, or its radiance on a screen.
            facing: "y" for an upright picture that faces +y, "z" for a lying one that is read from +y.
        """
        half, high = 0.5 * size[0], size[1]
        x, y, z = place
        # Seen from +y, the left edge lies at +x.
        if facing == "z":
            points = np.array([(x + half, y, z), (x - half, y, z), (x - half, y - high, z), (x + half, y - high, z)])
        else:
            points = np.array([(x + half, y, z), (x - half, y, z), (x - half, y, z + high), (x + half, y, z + high)])
        left, bottom, right, top = shown
        uv = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
        self._add(Solid(points, (np.array([[0, 1, 2, 3]]),)), material, tint, uv=uv)

    def daylight_through(self, width: float, height: float) -> None:
        """Let daylight in, towards +y, through an opening in the plane y = 0 of the current frame."""
        self.daylight.append(Daylight(self.frame.copy(), width, height))

    def _placed(self, points: Points) -> Points:
        placed: Points = points @ self.frame[:3, :3].T + self.frame[:3, 3]
        return placed

    def _add(
        self,
        solid: Solid,
        material: str,
        tint: Colour,
        *,
        offset: tuple[float, float, float] = (0.0, 0.0, 0.0),
        frame: Points | None = None,
        uv: Points | None = None,
    ) -> None:
        own = solid.points @ frame[:3, :3].T + frame[:3, 3] if frame is not None else solid.points + offset
        local = self._local(solid.points, own, material)
        colours = np.tile(np.array([*tint, self.rng.random()]), (len(own), 1))
        part = Part(self._placed(own), solid.faces, colours, local, solid.smooth, uv)
        self.parts.setdefault(material, []).append(part)

    def _local(self, points: Points, own: Points, material: str) -> Points:
        """Compute the positions at which a material's pattern is read.

        They run along the solid's longest axis, or for a material in `COURSED` along the level courses of its wall.
        """
        edges = np.ptp(points, axis=0)
        if material in COURSED:
            level = [0, 1] if edges[0] >= edges[1] else [1, 0]
            upright = [level[0], 2, level[1]]
            return own[:, upright if edges[2] > 0.05 else [0, 1, 2]]
        order = np.argsort(-edges, kind="stable")
        return points[:, order] + self.rng.uniform(0, 50, 3)
