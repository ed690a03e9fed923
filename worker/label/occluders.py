"""Sticks and pegs, which hide cables: in labels they are background, before some cables and behind others."""

from worker.cable.piece import OCCLUDER, Plain, Substance, Tubular
from worker.clutter.peg import peg_outline
from worker.clutter.sticks import stick_outline
from worker.geometry import SettledGeometry


def hiding_pieces(geometry: SettledGeometry) -> list[Tubular]:
    """The silhouettes of settled sticks and pegs, for `worker.label.label.label_cables`; no render needs them.

    A floor that is not seen has no clutter on it.
    """
    if geometry.scene.floor is None:
        return []
    sticks = [
        Tubular(OCCLUDER, curve, radius, 0.0, stick.length_m, stick.length_m, Plain(Substance.PLASTIC, stick.colour))
        for stick, nodes in geometry.sticks
        for curve, radius in stick_outline(stick, nodes)
    ]
    pegs = [
        Tubular(OCCLUDER, curve, radius, 0.0, peg.height_m, peg.height_m, Plain(Substance.PLASTIC, peg.colour))
        for peg, _ in geometry.pegs
        for curve, radius in peg_outline(peg)
    ]
    return sticks + pegs
