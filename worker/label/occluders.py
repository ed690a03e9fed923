"""Sticks as what hides cables: in labels they are background, in front of some cables and beneath others."""

from farm.scene.scene import Scene
from worker.cable.piece import OCCLUDER, Plain, Substance, Tubular
from worker.clutter.sticks import stick_outline
from worker.simulate.shapes import CableShapes


def hiding_pieces(scene: Scene, shapes: CableShapes) -> list[Tubular]:
    """The silhouettes of a settled scene's sticks, for `worker.label.label.label_cables`; no render needs them.

    Args:
        scene: what was drawn; a floor that is not seen has no clutter on it.
        shapes: it settled.
    """
    if scene.floor is None:
        return []
    sticks = scene.sticks[: len(shapes.sticks_m)]
    return [
        Tubular(OCCLUDER, curve, radius, 0.0, stick.length_m, stick.length_m, Plain(Substance.PLASTIC, stick.colour))
        for stick, nodes in zip(sticks, shapes.sticks_m, strict=True)
        for curve, radius in stick_outline(stick, nodes)
    ]
