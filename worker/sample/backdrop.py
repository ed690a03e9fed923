"""Draws of what is behind the cables: the HDRI and how it is turned, or a photograph."""

import numpy as np

from farm.scene.backdrop import HdriWorld, Plate
from farm.spec.category import Background
from farm.spec.header import DatasetHeader, HdriRef
from worker.sample.values import chance, uniform

OVER_FLOORS = "sunrise"
"""Of Blender's HDRIs the one under which floors are as bright, and have as much contrast, as in published examples."""


def sample_plate(header: DatasetHeader, rng: np.random.Generator) -> Plate | None:
    """Draw which of the user's photographs is behind the cables, and what part of it; None where none is."""
    ranges = header.spec.ranges.plate
    if not header.plates or not chance(rng, ranges.share):
        return None
    return Plate(
        name=header.plates[int(rng.integers(len(header.plates)))].name,
        x=float(rng.random()),
        y=float(rng.random()),
        zoom=uniform(rng, ranges.zoom),
        mirror=chance(rng, 0.5),
        blur_px=uniform(rng, ranges.blur_px) * header.spec.resolution / 512,
    )


def sample_world(header: DatasetHeader, background: Background, rng: np.random.Generator) -> HdriWorld:
    """Draw the HDRI, its turn and its brightness."""
    ranges = header.spec.ranges.world
    backdrops = [hdri for hdri in header.hdris if hdri.backdrop] or list(header.hdris)
    drawn = backdrops[int(rng.integers(len(backdrops)))]
    rotation = uniform(rng, ranges.rotation_deg)
    brightness = uniform(rng, ranges.dark_brightness)
    tilt = float(ranges.close_tilts_deg[int(rng.integers(len(ranges.close_tilts_deg)))])
    # Every value is drawn whatever the category, so that the streams of two categories stay comparable.
    over_floor = background is Background.FLOOR
    hdri = _fixed_hdri(header) if over_floor and ranges.one_over_floors else drawn
    return HdriWorld(
        hdri=hdri.name,
        rotation_deg=rotation,
        tilt_deg=tilt if over_floor else 90.0,
        brightness=brightness if hdri.dark else 0.0,
    )


def _fixed_hdri(header: DatasetHeader) -> HdriRef:
    """The one HDRI that lights all close pictures without a lamp: the named one, else `OVER_FLOORS`, else the first."""
    name = header.spec.close_distributed_hdri or OVER_FLOORS
    return next((hdri for hdri in header.hdris if hdri.name == name), header.hdris[0])
