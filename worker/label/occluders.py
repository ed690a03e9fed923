"""Sticks, which hide cables: in labels they are background, in front of some cables and beneath others."""

from worker.cable.piece import OCCLUDER, Plain, Substance, Tubular
from worker.clutter.sticks import stick_outline
from worker.geometry import SettledGeometry


def hiding_pieces(geometry: SettledGeometry) -> list[Tubular]:
    """The silhouettes of a settled scene's sticks, for `worker.label.label.label_cables`; no render needs them.

    A floor that is not seen has no clutter on it.
    """
    if geometry.scene.floor is None:
        return []
    return [
        Tubular(OCCLUDER, curve, radius, 0.0, stick.length_m, stick.length_m, Plain(Substance.PLASTIC, stick.colour))
        for stick, nodes in geometry.sticks
        for curve, radius in stick_outline(stick, nodes)
    ]
