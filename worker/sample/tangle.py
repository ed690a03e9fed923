"""Samples tangles: heaps, knots, threaded loops, crossed bundles, and cables round a peg."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from farm.scene.cable import Cable
from farm.scene.camera import Camera
from farm.scene.clutter import Peg
from farm.scene.knot import Knot, KnotKind
from farm.spec.category import Background, CategoryTraits, Disposition
from farm.spec.ranges.placement import SPACING_DIAMETERS
from farm.spec.ranges.tangle import TangleRanges
from worker.sample.diagram import Diagram, turned, weave_diagram
from worker.sample.peg_diagram import run_round_peg
from worker.sample.tangle_diagrams import cross_bundles, heap_up, thread
from worker.sample.values import chance, log_uniform, uniform

TRIES = 4
"""Diagrams that are drawn for one tangle before the scene goes without."""

HIGHEST_PEG = 0.4
"""Greatest height of a peg, as a share of the camera's; the checks ask for less than 0.9 of where its view begins."""

_KNOT_ROOM_RADII = 23.0
"""Least length of a cable with a knot, in radii of the knot's loop. A figure of eight takes up to 9.5 on either side of
its middle, which lies at least 0.42 of the length from the nearer end."""

_KNOT_REACH = 0.2
"""Largest distance of a knot from the picture's middle along each axis, as a share of its shorter edge."""

_WIDEST_LOOP = 0.2
"""Largest radius of a knot's loop, as a share of the picture's shorter edge."""


class TangleKind(StrEnum):
    """The kind of a tangle."""

    HEAP = "heap"
    KNOT = "knot"
    THREADED = "threaded"
    CROSSED_BUNDLES = "crossed_bundles"
    PEG = "peg"


@dataclass(frozen=True, slots=True)
class Tangled:
    """The cables of a scene, tangled or not, and the pegs round which they run."""

    cables: tuple[Cable, ...]
    pegs: tuple[Peg, ...] = ()


_Draw = Callable[[TangleRanges, tuple[Cable, ...], float, np.random.Generator], Diagram | None]

_DRAWS: Mapping[TangleKind, tuple[int, _Draw]] = {
    TangleKind.HEAP: (2, heap_up),
    TangleKind.THREADED: (2, thread),
    TangleKind.CROSSED_BUNDLES: (3, cross_bundles),
    TangleKind.PEG: (1, run_round_peg),
}
"""For each kind that is woven, the fewest cables and the source of its diagrams."""


def sample_kind(ranges: TangleRanges, traits: CategoryTraits, rng: np.random.Generator) -> TangleKind | None:
    """Draw the kind of a scene's tangle; None is no tangle.

    Args:
        ranges: ranges of the style.
        traits: traits of the category, which may rule a kind out.
        rng: random generator of the tangle.
    """
    drawn, below = float(rng.random()), 0.0
    for kind in TangleKind:
        below += getattr(ranges, f"{kind}_share")
        if drawn < below:
            return kind if _suits(kind, traits) else None
    return None


def _suits(kind: TangleKind, traits: CategoryTraits) -> bool:
    if kind is TangleKind.KNOT:
        return True
    stands = kind is not TangleKind.PEG or traits.background is Background.FLOOR
    return stands and traits.disposition is Disposition.FREE


def tangle(
    kind: TangleKind | None,
    ranges: TangleRanges,
    cables: tuple[Cable, ...],
    camera: Camera,
    edge_m: float,
    rng: np.random.Generator,
    *,
    lowest_m: float,
) -> Tangled:
    """Tangle the cables of a scene; they stay as they are if there are too few of them, or no room.

    Args:
        kind: kind of the tangle; None is none.
        ranges: ranges of the style.
        cables: sampled cables, one above the other.
        camera: camera of the picture, above every peg.
        edge_m: shorter edge of the picture on the floor, in metres, within which the tangle lies.
        rng: random generator of the tangle.
        lowest_m: height of the lowest cable's underside above the floor, in metres.
    """
    untangled = Tangled(cables)
    if kind is TangleKind.KNOT:
        return Tangled(_knotted(ranges, cables, edge_m, rng)) if cables else untangled
    if kind is None or len(cables) < _DRAWS[kind][0]:
        return untangled
    for _ in range(TRIES):
        diagram = _DRAWS[kind][1](ranges, cables, edge_m, rng)
        woven = None if diagram is None else weave_diagram(diagram, lowest_m, rng)
        if diagram is None or woven is None:
            continue
        if diagram.peg is None:
            return Tangled(woven)
        peg = _raised(diagram.peg, woven, camera)
        if peg is not None:
            return Tangled(woven, (peg,))
    return untangled


def _raised(peg: Peg, cables: tuple[Cable, ...], camera: Camera) -> Peg | None:
    """Make a peg higher than the cables about it; None if a camera would then be too near to it."""
    top = max(cable.start_height_m + max(cable.heights_m) + 2 * cable.diameter_m for cable in cables)
    height = max(peg.height_m, top)
    limit = HIGHEST_PEG * camera.height_m * float(np.cos(np.radians(camera.tilt_deg)))
    if top > limit:
        return None
    return peg.model_copy(update={"height_m": min(height, limit)})


def _knotted(
    ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator
) -> tuple[Cable, ...]:
    """Tie a knot in a cable that is long and thin enough for one, if there is any.

    It becomes the highest cable, so that nothing starts within the knot, however high that is.
    """
    able = [
        k for k, each in enumerate(cables) if ranges.knot_loop_diameters[0] * each.diameter_m <= _most_m(each, edge_m)
    ]
    if not able:
        return cables
    chosen = able[int(rng.integers(len(able)))]
    cable = cables[chosen]
    others = [each for k, each in enumerate(cables) if k != chosen]
    top = max((each.start_height_m + each.rise_m + SPACING_DIAMETERS * each.diameter_m for each in others), default=0.0)
    along = float(rng.uniform(0.42, 0.58))
    place = rng.uniform(-_KNOT_REACH, _KNOT_REACH, 2) * edge_m
    knot = Knot(
        kind=KnotKind.FIGURE_EIGHT if chance(rng, ranges.figure_eight_share) else KnotKind.OVERHAND,
        along=along,
        loop_radius_m=log_uniform(rng, ranges.knot_loop_diameters) * cable.diameter_m,
        mirrored=chance(rng, 0.5),
        set_share=uniform(rng, ranges.knot_set_share),
    )
    # The knot takes up length on both sides alike, so it lies as far from the chord's middle as along the cable.
    x, y = place - turned(np.array([(along - 0.5) * cable.length_m, 0.0]), cable.rotation_deg)
    tied = {
        "knot": knot.model_copy(update={"loop_radius_m": min(knot.loop_radius_m, _most_m(cable, edge_m))}),
        "start_height_m": max(cable.start_height_m, top),
        "x_m": float(x),
        "y_m": float(y),
        "rise_m": 0.0,
    }
    return (*others, cable.model_copy(update=tied))


def _most_m(cable: Cable, edge_m: float) -> float:
    """Compute the largest radius of a knot's loop for which a cable is long enough and a picture large enough."""
    return min(cable.length_m / _KNOT_ROOM_RADII, _WIDEST_LOOP * edge_m)
