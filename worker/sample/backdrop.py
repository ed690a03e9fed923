"""Samples what the picture shows behind the cables: an HDRI and its rotation, or a photograph."""

import numpy as np

from farm.scene.backdrop import HdriWorld, Plate
from farm.spec.category import Background
from farm.spec.header import DatasetHeader, HdriRef
from worker.sample.values import chance, uniform

OVER_FLOORS = "sunrise"
"""Name of the one of Blender's HDRIs that lights floors as brightly, and with as much contrast, as in published
examples."""


def sample_plate(header: DatasetHeader, rng: np.random.Generator) -> Plate | None:
    """Sample which of the user's photographs is behind the cables, and which part of it.

    Args:
        header: header of the dataset, with its photographs and ranges.
        rng: random generator of the photograph.

    Returns:
        The photograph's part; None if the dataset has no photographs, or this picture shows none.
    """
    ranges = header.spec.ranges.plate
    if not header.plates or not chance(rng, ranges.share):
        return None
    return Plate(
        name=header.plates[int(rng.integers(len(header.plates)))].name,
        x=float(rng.random()),
        y=float(rng.random()),
        zoom=uniform(rng, ranges.zoom),
        mirror=chance(rng, 0.5),
        blur_px=uniform(rng, ranges.blur_px) * header.spec.resolution.longer / 512,
    )


def sample_world(header: DatasetHeader, background: Background, rng: np.random.Generator) -> HdriWorld:
    """Sample the HDRI, its rotation and its brightness.

    Args:
        header: header of the dataset, with its HDRIs and ranges.
        background: background of the cables: the HDRI itself, or a floor that the HDRI lights.
        rng: random generator of the HDRI.
    """
    ranges = header.spec.ranges.world
    backdrops = [hdri for hdri in header.hdris if hdri.backdrop] or list(header.hdris)
    drawn = backdrops[int(rng.integers(len(backdrops)))]
    rotation = uniform(rng, ranges.rotation_deg)
    brightness = uniform(rng, ranges.dark_brightness)
    tilt = float(ranges.close_tilts_deg[int(rng.integers(len(ranges.close_tilts_deg)))])
    # Every value is sampled for every category, so that the streams of two categories stay comparable.
    over_floor = background is Background.FLOOR
    hdri = _fixed_hdri(header) if over_floor and ranges.one_over_floors else drawn
    return HdriWorld(
        hdri=hdri.name,
        rotation_deg=rotation,
        tilt_deg=tilt if over_floor else 90.0,
        brightness=brightness if hdri.dark else 0.0,
    )


def _fixed_hdri(header: DatasetHeader) -> HdriRef:
    """Find the HDRI that lights all close pictures without a lamp: the named one, or `OVER_FLOORS`, or the first."""
    name = header.spec.close_distributed_hdri or OVER_FLOORS
    return next((hdri for hdri in header.hdris if hdri.name == name), header.hdris[0])
