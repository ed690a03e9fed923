"""Circuit boards: solder mask over copper, pads and vias, white print, and small components."""

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.cells import mask_distance
from assets.surfaces.kit.circuit_layout import VIA_MM, Body, BodyKind, CircuitBoard, Pad, lay_out
from assets.surfaces.kit.colour import mix, plain, ramp, shade
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.lettering import stamp, text_patch
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import scratches, specks, stains
from assets.surfaces.kit.noise import blur, fractal, smoothstep
from assets.surfaces.kit.strokes import Image, as_field, polygon, polylines
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

BODY_COLOURS = {
    BodyKind.CHIP: "2a2b2d",
    BodyKind.RESISTOR: "2c2d31",
    BodyKind.CAPACITOR: "b1916a",
    BodyKind.HEADER: "232426",
}
"""Colour of a component's body, hexadecimal sRGB."""
BODY_HEIGHTS_MM = {BodyKind.CHIP: 1.2, BodyKind.RESISTOR: 0.5, BodyKind.CAPACITOR: 0.8, BodyKind.HEADER: 1.4}
"""Height of a component's body over the board, millimetres."""


def circuit_board_green(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Green circuit board with tinned pads; three quarters of its parts are soldered on."""
    return _board(rng, grid, ("16452e", "2b6e46"), "c9cbca", fitted=0.75)


def circuit_board_blue(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Blue circuit board with gilded pads, nearly bare of parts."""
    return _board(rng, grid, ("17386b", "2c5c9c"), "d9b966", fitted=0.12)


def _board(rng: np.random.Generator, grid: Grid, mask: tuple[str, str], metal: str, fitted: float) -> SurfaceMaps:
    """Draw a board.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        mask: Colours of the solder mask over bare laminate and over copper, hexadecimal.
        metal: Colour of the pads, hexadecimal.
        fitted: Probability that a component is soldered on.

    Returns:
        The maps.
    """
    board = lay_out(rng, grid.size_mm)
    bodies = [body for body in board.bodies if rng.random() < fitted]
    pads, drilled = _pads(board, grid)
    copper = np.maximum(_copper(rng, grid, board, pads), pads)
    print_ = _print(board, grid) * (1 - pads)
    cloud = fractal(rng, grid, 90, 2, gain=0.6)
    weave = fractal(rng, grid, 1.4, 0.3, gain=0.8)
    laminate = shade(plain(mask[0], cloud), 1 + 0.05 * cloud + 0.04 * weave)
    covered = shade(plain(mask[1], cloud), 1 + 0.05 * cloud + 0.015 * weave)
    colour = mix(laminate, covered, copper)
    colour = mix(colour, "e3e5df", np.asarray(0.9 * print_ * smoothstep(-2.4, -0.6, cloud + 0.5 * weave), np.float32))
    tin = ramp(0.5 + 0.16 * fractal(rng, grid, 6, 0.3, gain=0.75), ((0.0, "8d8c88"), (1.0, "ffffff")))
    colour = mix(colour, shade(plain(metal, cloud), tin[..., 0]), pads)
    colour = mix(colour, "121211", 0.95 * drilled)
    height = 0.05 * copper + 0.012 * print_ + 0.16 * blur(pads, 0.2, grid) - 0.4 * drilled
    rough = 0.3 + 0.03 * weave + 0.3 * print_ - 0.04 * pads + 0.4 * drilled
    metallic = pads * (1 - drilled)
    part = _Parts(grid)
    for body in bodies:
        part.put(body, metal)
    shadow = hollows(part.height_mm, 0.9, 0.7, grid) * (1 - part.mask)
    colour = mix(shade(colour, 1 - 0.45 * shadow), part.colour, part.mask)
    height = height * (1 - part.mask) + part.height_mm
    rough = rough + (0.55 - rough) * part.mask
    metallic = metallic * (1 - part.mask) + part.metal
    body_stain, rim = stains(rng, grid, 40, 0.05)
    colour = mix(colour, "a5a284", 0.1 * body_stain + 0.16 * rim)
    marks = scratches(rng, grid, 60, 0.12)
    colour = mix(colour, "a9b5a8", 0.28 * marks)
    lint = specks(rng, grid, 0.0015, 0.4)
    dusty = smoothstep(0.0, 2.4, fractal(rng, grid, 80, 0.6, gain=0.68))
    colour = mix(mix(colour, "b5b1a4", 0.5 * lint), "8f8c80", 0.12 * dusty)
    rough = rough + 0.15 * dusty + 0.12 * body_stain
    return finish(
        grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), np.asarray(metallic, np.float32)
    )


class _Parts:
    """The bodies of the components drawn so far: colour (H, W, 3); height in mm, mask and bare metal, each (H, W)."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid
        self.colour = np.zeros((grid.pixels, grid.pixels, 3), np.float32)
        self.height_mm = grid.zeros()
        self.mask = grid.zeros()
        self.metal = grid.zeros()

    def put(self, body: Body, metal: str) -> None:
        """Draw a body on the board, with its metal caps, its pins or the marking of a chip."""
        texel = self._grid.texel_mm
        wide, high = (max(3, round(edge / texel)) for edge in (body.width, body.height))
        top, left = round(body.y / texel - high / 2), round(body.x / texel - wide / 2)
        edge = self._grid.pixels
        where = np.ix_(np.arange(top, top + high) % edge, np.arange(left, left + wide) % edge)
        v, u = np.meshgrid(np.arange(high) + 0.5, np.arange(wide) + 0.5, indexing="ij")
        inset = np.minimum(np.minimum(u, wide - u), np.minimum(v, high - v)) * texel
        slope = np.clip(inset / 0.25, 0, 1)
        face = plain(BODY_COLOURS[body.kind], inset.astype(np.float32)) * (0.8 + 0.2 * slope[..., None])
        bare = np.zeros_like(inset)
        if body.kind in (BodyKind.RESISTOR, BodyKind.CAPACITOR):
            along = np.minimum(u, wide - u) * texel if wide > high else np.minimum(v, high - v) * texel
            bare = (along < 0.5).astype(np.float32)
            face = mix(face.astype(np.float32), "c3c4c3", np.asarray(bare, np.float32))
        elif body.kind is BodyKind.HEADER:
            pitch = 2.4 / texel
            pin = np.maximum(np.abs(np.mod(u, pitch) - pitch / 2), np.abs(np.mod(v, pitch) - pitch / 2)) * texel
            bare = (pin < 0.35).astype(np.float32)
            face = mix(face.astype(np.float32), metal, np.asarray(bare, np.float32))
        else:
            self._mark(face, body, wide, high)
        self.colour[where] = face
        self.height_mm[where] = BODY_HEIGHTS_MM[body.kind] * (0.55 + 0.45 * slope)
        self.mask[where] = 1.0
        self.metal[where] = bare

    def _mark(self, face: Field, body: Body, wide: int, high: int) -> None:
        """Print a chip's name on it and press the dot that marks its first pin."""
        label = text_patch(f"{body.name}-{len(body.name) * 37}{wide % 10}", 0.9, self._grid)
        if wide < high:
            label = np.ascontiguousarray(np.rot90(label))
        rows, columns = label.shape
        top, left = (high - rows) // 2, (wide - columns) // 2
        if top >= 0 and left >= 0:
            ink = as_field(label)[..., None] * 0.5
            block = face[top : top + rows, left : left + columns]
            face[top : top + rows, left : left + columns] = block + (0.72 - block) * ink
        v, u = np.mgrid[0:high, 0:wide] * self._grid.texel_mm
        dot = smoothstep(0.32, 0.45, np.hypot(u - 0.9, v - 0.9))
        face *= (0.55 + 0.45 * dot)[..., None]


def _pads(board: CircuitBoard, grid: Grid) -> tuple[Field, Field]:
    """Bare metal and drilled holes, each 0 to 1."""
    metal, holes = np.zeros((2, grid.pixels, grid.pixels), np.uint8)
    for pad in board.pads:
        if pad.drill > 0:
            _disc(metal, pad.x, pad.y, pad.width, grid)
            _disc(holes, pad.x, pad.y, pad.drill, grid)
        else:
            polygon(metal, _corners(pad), (255.0,), grid)
    for x, y in board.vias[::3]:
        # Every third via is open; the others lie under the mask.
        _disc(metal, x, y, 0.55, grid)
        _disc(holes, x, y, 0.25, grid)
    return as_field(metal), as_field(holes)


def _copper(rng: np.random.Generator, grid: Grid, board: CircuitBoard, pads: Field) -> Field:
    """Copper under the mask: traces, vias, and poured areas that keep clear of them; 0 to 1."""
    lines: Image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for trace in board.traces:
        polylines(lines, trace.path, trace.width, (255.0,), grid)
    for x, y in board.vias:
        _disc(lines, x, y, VIA_MM, grid)
    drawn = np.maximum(as_field(lines), pads)
    clearance = mask_distance(drawn < 0.4, grid, 6.0)
    return np.maximum(drawn, smoothstep(0.3, 0.42, clearance) * _poured(rng, grid))


def _poured(rng: np.random.Generator, grid: Grid) -> Field:
    """Mask of the areas filled with copper, 0 to 1: overlapping rectangles with cut corners, some left out."""
    image: Image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for number in range(34):
        middle, half = rng.uniform(0, grid.size_mm, 2), rng.uniform(9, 42, 2)
        cut = float(rng.uniform(1.0, 6.0))
        inner = half - cut
        corners = [(half[0], inner[1]), (inner[0], half[1]), (-inner[0], half[1]), (-half[0], inner[1])]
        octagon = np.array(corners + [(-x, -y) for x, y in corners])
        # Every fourth area is cleared instead, so that the areas don't merge into one.
        polygon(image, octagon + middle, (0.0 if number % 4 == 3 else 255.0,), grid)
    return as_field(image)


def _print(board: CircuitBoard, grid: Grid) -> Field:
    """The white print: outlines, the first pin's corner, and names beside the components; 0 to 1."""
    image: Image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for body in board.bodies:
        small = body.kind in (BodyKind.RESISTOR, BodyKind.CAPACITOR)
        gap = 0.55 if small else 0.3
        outline = _corners(Pad(body.x, body.y, body.width + 2 * gap, body.height + 2 * gap))
        polylines(image, np.concatenate([outline, outline[:1]]), 0.15, (235.0,), grid)
        name = text_patch(body.name, 0.95, grid, 0.15)
        standing = body.height > body.width
        aside = 0.5 * (body.width if standing else body.height) + (2.6 if body.kind is BodyKind.CHIP else 1.5)
        x, y = (body.x + aside, body.y) if standing else (body.x, body.y - aside)
        stamp(image, np.ascontiguousarray(np.rot90(name)) if standing else name, x, y, grid)
    return as_field(image)


def _corners(pad: Pad) -> npt.NDArray[np.float64]:
    """Corners of a pad in millimetres, shape (4, 2)."""
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.array([pad.width, pad.height]) / 2
    return np.asarray(half + np.array([pad.x, pad.y]))


def _disc(image: Image, x: float, y: float, diameter: float, grid: Grid) -> None:
    turn = np.linspace(0, 2 * np.pi, 14, endpoint=False)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=1) * diameter / 2
    polygon(image, circle + np.array([x, y]), (255.0,), grid)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.ELECTRONICS, 0.3, draw, version=2)
    for name, draw in (
        ("circuit_board_green", circuit_board_green),
        ("circuit_board_blue", circuit_board_blue),
    )
)
