"""Takes a settled scene's cables to pieces, which are rendered, labelled and measured for coverage. Pure numpy.

A cable consists of its sheath and of what comes out of the sheath at its ends; a bundle consists of its strands, each
like a cable, and of the ties around them. The picture and its masks are made from the same pieces.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.scene.cable import Bundle, Cable, CableEnd, EndKind, Skin
from farm.scene.scene import Scene
from worker.cable.piece import Piece, Plain, Substance, Surface, Tubular
from worker.cable.strands import places, strand_radius, turning
from worker.cable.tie import GOLDEN, is_clear, solids_of
from worker.curves import Points

_CONDUCTOR = 0.55
"""Radius of a conductor over that of its sheath, for example 1.0 mm in 1.8 mm."""

_COLLAR_M = 0.006
"""Longest collar of a ferrule, in metres."""

_COLLAR_SHARE = 0.6
"""Longest collar of a ferrule, as a share of the whole ferrule."""

_TUBE = 0.6
"""Radius of a ferrule's metal tube over that of the sheath."""

_MOST_BARE = 0.4
"""Largest bare part of one end, as a share of the cable's length."""

_FINE_LAY = 14.0
"""Length over which a conductor's fine strands turn once, in its diameters: flexible wires have 10 to 16."""

_SHIFTS_M = tuple(sign * step / 1000 for step in range(0, 61, 4) for sign in (1, -1))
"""Distances by which a tie may be moved along its bundle, in metres, tried in this order, to keep clear of other cables
and of sticks."""

_COPPER = (184, 115, 81)
"""Colour of copper, sRGB levels."""

_TIN = (190, 190, 186)
"""Colour of tin, sRGB levels."""


@dataclass(frozen=True, slots=True)
class _Strand:
    """A cable, or a strand of a bundle.

    Attributes:
        instance: instance number, from 1.
        curve: (N, 3) metres, centreline along the whole cable.
        radius_m: radius in metres.
        surface: surface of the sheath.
        cut_m: lengths by which it is shorter than the cable at the beginning and at the end, in metres.
    """

    instance: int
    curve: Points
    radius_m: float
    surface: Surface
    cut_m: tuple[float, float]


def pieces_of(
    scene: Scene, curves: Sequence[Points], sticks_m: Sequence[Points], pegs_m: Sequence[Points] = ()
) -> list[Piece]:
    """Take a settled scene's cables to pieces.

    Args:
        scene: sampled scene.
        curves: centreline of each settled cable, (N, 3) metres, finely sampled.
        sticks_m: nodes of each settled stick's axis, (N, 3) metres; none if the simulator has no sticks.
        pegs_m: nodes of each peg's axis, (N, 3) metres; none if the simulator has no pegs.

    Returns:
        The pieces. Instances are numbered as `farm.dataset.instances.number_instances` does; ties are occluders. The
        fall does not know of ties: a tie that would cut another cable, a stick or a peg is moved along its bundle, or
        left out if there is no room.
    """
    sticks = [
        (_dense(axis), stick.diameter_m / 2)
        for stick, axis in zip(scene.sticks[: len(sticks_m)], sticks_m, strict=True)
    ]
    pegs = [(_dense(axis), peg.diameter_m / 2) for peg, axis in zip(scene.pegs[: len(pegs_m)], pegs_m, strict=True)]
    pieces: list[Piece] = []
    instance = 1
    for number, (cable, curve) in enumerate(zip(scene.cables, curves, strict=True)):
        if isinstance(cable.material, Bundle):
            others = [(curves[k], scene.cables[k].diameter_m / 2) for k in range(len(curves)) if k != number]
            pieces += _bundle(cable, cable.material, curve, [*others, *sticks, *pegs], instance)
            instance += len(cable.material.strands)
        else:
            strand = _Strand(instance, curve, cable.diameter_m / 2, cable.material, (0.0, 0.0))
            pieces += _with_ends(strand, cable)
            instance += 1
    return pieces


def _dense(axis: Points) -> Points:
    """Interpolate a stick's axis (N, 3) to points at most a millimetre apart."""
    points = round(float(np.linalg.norm(axis[-1] - axis[0])) / 0.001) + 2
    share: NDArray[np.float64] = np.linspace(0.0, 1.0, points)[:, None]
    dense: Points = axis[0] + share * (axis[-1] - axis[0])
    return dense


def _bundle(
    cable: Cable, bundle: Bundle, curve: Points, others: Sequence[tuple[Points, float]], instance: int
) -> list[Piece]:
    count = len(bundle.strands)
    wanted_m, envelope_m = bundle.strand_diameter_m / 2, cable.diameter_m / 2
    radius_m = strand_radius(count, wanted_m, envelope_m, bundle.lay_m)
    offsets_m = places(count) * strand_radius(count, wanted_m, envelope_m, 0.0)
    arc = np.linspace(0.0, cable.length_m, len(curve))
    lines = turning(curve, offsets_m, arc, bundle.lay_m, bundle.phase_deg)
    pieces: list[Piece] = []
    for number, (line, skin) in enumerate(zip(lines, bundle.strands, strict=True)):
        cut_m = (_uneven(skin, number, 0) * 3 * radius_m, _uneven(skin, number, 1) * 3 * radius_m)
        pieces += _with_ends(_Strand(instance + number, line, radius_m, skin, cut_m), cable)
    taken = list(others)
    for tie in bundle.ties:
        for shift_m in _SHIFTS_M:
            moved = tie.model_copy(update={"along": tie.along + shift_m / cable.length_m})
            solids = solids_of(
                moved, curve, cable.length_m, offsets_m, radius_m, lay_m=bundle.lay_m, phase_deg=bundle.phase_deg
            )
            if all(is_clear(solids, other, thick_m) for other, thick_m in taken):
                pieces += solids
                taken.append((solids[0].rings.mean(axis=(0, 1))[None], tie.width_m))
                break
    return pieces


def _uneven(skin: Skin, number: int, end: int) -> float:
    """Compute a share from 0 to 1 that differs from strand to strand, and from end to end."""
    return (GOLDEN * (skin.pattern_seed % 9973 + 3 * number + 11 * end)) % 1.0


def _with_ends(strand: _Strand, cable: Cable) -> list[Piece]:
    length_m = cable.length_m
    bare_m = [
        0.0 if end.kind is EndKind.CUT else min(end.bare_m, _MOST_BARE * length_m - cut)
        for end, cut in zip(cable.ends, strand.cut_m, strict=True)
    ]
    first_m, last_m = strand.cut_m[0], length_m - strand.cut_m[1]
    pieces: list[Piece] = [_stretch(strand, length_m, first_m + bare_m[0], last_m - bare_m[1])]
    if bare_m[0] > 0:
        pieces += _end(strand, length_m, cable.ends[0], first_m + bare_m[0], first_m)
    if bare_m[1] > 0:
        pieces += _end(strand, length_m, cable.ends[1], last_m - bare_m[1], last_m)
    return pieces


def _stretch(strand: _Strand, length_m: float, start_m: float, end_m: float) -> Tubular:
    """Make the sheath between two places along the cable."""
    whole = start_m == 0.0 and end_m == length_m
    curve = strand.curve if whole else _between(strand.curve, length_m, start_m, end_m)
    return Tubular(strand.instance, curve, strand.radius_m, start_m, end_m, length_m, strand.surface)


def _end(strand: _Strand, length_m: float, end: CableEnd, from_m: float, to_m: float) -> list[Piece]:
    """Make the pieces that come out of the sheath at `from_m` and end at `to_m`, places along the cable in metres."""
    if end.kind is EndKind.FERRULE:
        return _ferrule(strand, length_m, end, from_m, to_m)
    curve = _between(strand.curve, length_m, from_m, to_m)
    fine_m = _CONDUCTOR * strand.radius_m / 3
    reach = np.linspace(0.0, 1.0, len(curve))
    # Cut strands spring apart within the sheath's width, more towards the tip, and each by another amount.
    spread = np.array([0.75 * ((GOLDEN * (strand.instance + 3 * k)) % 1.0) for k in range(7)])
    widths = 1.0 + spread[:, None] * reach**1.5
    offsets_m = fine_m * places(7)[:, None] * widths[..., None]
    arc = np.linspace(0.0, abs(to_m - from_m), len(curve))
    lines = turning(curve, offsets_m, arc, 6 * _FINE_LAY * fine_m, 40.0 * strand.instance)
    copper = Plain(Substance.COPPER, _COPPER)
    return [Tubular(strand.instance, line, fine_m, from_m, to_m, length_m, copper) for line in lines]


def _ferrule(strand: _Strand, length_m: float, end: CableEnd, from_m: float, to_m: float) -> list[Piece]:
    """Make a ferrule: a collar that narrows towards the metal tube, and the tube."""
    bare_m = abs(to_m - from_m)
    waist_m = from_m + min(_COLLAR_M, _COLLAR_SHARE * bare_m) * np.sign(to_m - from_m)
    collar = _between(strand.curve, length_m, from_m, waist_m)
    tube = _between(strand.curve, length_m, waist_m, to_m)
    narrowing = np.interp(np.linspace(0, 1, len(collar)), [0.0, 0.1, 0.55, 0.9, 1.0], [0.94, 1.0, 0.97, 0.8, 0.72])
    plastic, tin = Plain(Substance.PLASTIC, end.collar), Plain(Substance.TIN, _TIN)
    return [
        Tubular(strand.instance, collar, strand.radius_m * narrowing, from_m, waist_m, length_m, plastic),
        Tubular(strand.instance, tube, _TUBE * strand.radius_m, waist_m, to_m, length_m, tin),
    ]


def _between(curve: Points, length_m: float, start_m: float, end_m: float) -> Points:
    """Cut a curve between two places along it, in that order, at about its own spacing and at 9 points or more."""
    points = max(9, round(abs(end_m - start_m) / length_m * (len(curve) - 1)) + 1)
    knots = np.linspace(0.0, length_m, len(curve))
    wanted: NDArray[np.float64] = np.linspace(start_m, end_m, points)
    return np.stack([np.interp(wanted, knots, curve[:, axis]) for axis in range(3)], axis=1)
