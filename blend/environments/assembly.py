"""Many simple solids in few meshes: each has its place, its material and its own tint.

One mesh for each material renders faster than an object for each thing; what differs from thing to thing (its colour,
where its grain begins) lies in the mesh's attributes `tint` and `local`, which the materials read.
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
"""Where a picture lies in the atlas: left, bottom, right, top, each 0 to 1."""

COURSED = frozenset({"brick", "blocks", "ribbed", "tiles", "pegboard"})
"""Materials whose courses run level and go on from one solid to the next."""


@dataclass(frozen=True, slots=True)
class Part:
    """Faces of one material.

    Attributes:
        points: (N, 3), metres in the world.
        faces: index arrays (M, K) of polygons with K corners.
        tint: (N, 4) linear colour; for what shines its radiance. The fourth is one random number for each solid.
        local: (N, 3), metres along the solid's own axes, its longest first, from a random origin.
        smooth: shaded as if curved.
        uv: (N, 2), only of parts that show a picture.
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
        frame: (4, 4), takes its own frame (x across, z up, light goes towards y) into the world.
        width_m, height_m: its size.
    """

    frame: Points
    width_m: float
    height_m: float


@dataclass
class Assembly:
    """Collects solids. Placing is relative to the innermost `at`.

    Attributes:
        rng: of all that is drawn.
        parts: by material.
        daylight: the openings.
        things: how many things (not solids) were placed.
    """

    rng: np.random.Generator
    parts: dict[str, list[Part]] = field(default_factory=dict)
    daylight: list[Daylight] = field(default_factory=list)
    things: int = 0
    _frames: list[Points] = field(default_factory=lambda: [np.eye(4)])

    @property
    def frame(self) -> Points:
        """(4, 4), takes what is placed now into the world."""
        return self._frames[-1]

    @contextmanager
    def at(self, x: float, y: float, z: float = 0.0, turn: float = 0.0, lean: float = 0.0) -> Iterator["Assembly"]:
        """Place a thing: its origin, turned about the vertical, then leaned about its own x axis; degrees."""
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
        """A box; `place` is the middle of its underside, `bevel` the width of its chamfers in metres."""
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
        """A cylinder or cone from the middle of its end; `top` is the radius of the other end."""
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
        """A body of revolution: radius and distance along the axis, from its origin at `place`; ends are closed."""
        for solid in lathed(profile, axis, sides):
            self._add(solid, material, tint, offset=place)

    def tube(
        self, points: Sequence[tuple[float, float, float]] | Points, radius: float, material: str, tint: Colour
    ) -> None:
        """A round tube along points (N, 3)."""
        self._add(swept(np.asarray(points, np.float64), radius), material, tint)

    def prism(
        self, outline: Sequence[tuple[float, float]], x: float, width: float, material: str, tint: Colour
    ) -> None:
        """An outline in (y, z), counter-clockwise seen from +x, made `width` thick about `x`."""
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
        """Loose four-cornered faces (N, 4, 3) of tints (N, 3)."""
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
        """A picture of the atlas; `place` is the middle of its lower edge; it faces +y, or +z and is read from +y."""
        half, high = 0.5 * size[0], size[1]
        x, y, z = place
        # Seen from +y, what is on the left lies at +x.
        if facing == "z":
            points = np.array([(x + half, y, z), (x - half, y, z), (x - half, y - high, z), (x + half, y - high, z)])
        else:
            points = np.array([(x + half, y, z), (x - half, y, z), (x - half, y, z + high), (x + half, y, z + high)])
        left, bottom, right, top = shown
        uv = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
        self._add(Solid(points, (np.array([[0, 1, 2, 3]]),)), material, tint, uv=uv)

    def daylight_through(self, width: float, height: float) -> None:
        """Let daylight in through an opening that begins at the frame's origin, towards y."""
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
        """Where a material's pattern is read: along the solid's longest axis, or in a wall's own upright courses."""
        edges = np.ptp(points, axis=0)
        if material in COURSED:
            level = [0, 1] if edges[0] >= edges[1] else [1, 0]
            upright = [level[0], 2, level[1]]
            return own[:, upright if edges[2] > 0.05 else [0, 1, 2]]
        order = np.argsort(-edges, kind="stable")
        return points[:, order] + self.rng.uniform(0, 50, 3)
