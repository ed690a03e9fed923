"""Decides whether the settled cables and clutter leave room for the camera and the lamps. Pure numpy.

What lies nearer to the camera than where its view begins has no picture, and labels would still show it; a lamp inside
a cable lights nothing else.
"""

import numpy as np
from numpy.typing import NDArray

from farm.scene.camera import NEAR_CLIP_M
from farm.scene.light import AreaLamp, Lamp, StudioLamp
from worker.clutter.parts import part_extent
from worker.curves import Points
from worker.geometry import SettledGeometry

MARGIN = 0.1
"""Least room between the highest place of a settled scene and where the camera's view begins, as a share of the height
of the latter. In 540 falls of both styles the highest place reached 0.36 of the camera's height."""


def find_room_fault(geometry: SettledGeometry) -> str | None:
    """Find the reason why a scene must be drawn again; None if camera and lamps are clear of all that has settled."""
    return _camera_fault(geometry) or _lamp_fault(geometry)


def settled_top_m(geometry: SettledGeometry) -> float:
    """Compute the height of the highest place of cables, strands, ties, sticks, pegs and small parts, in metres."""
    tops = [piece.top_m for piece in geometry.pieces]
    tops += [float(axis[:, 2].max()) + stick.diameter_m / 2 for stick, axis in geometry.sticks]
    tops += [peg.height_m for peg, _ in geometry.pegs]
    if geometry.scene.floor is not None:
        tops += [part_extent(part)[1] for part in geometry.parts]
    return max(tops, default=0.0)


def _camera_fault(geometry: SettledGeometry) -> str | None:
    opening_m = geometry.view.lowest_opening_m(NEAR_CLIP_M, geometry.lens_radius_m)
    top_m, limit_m = settled_top_m(geometry), (1.0 - MARGIN) * opening_m
    if top_m <= limit_m:
        return None
    camera = geometry.scene.camera
    return (
        f"cables or clutter are {1e3 * top_m:.1f} mm high, above the {1e3 * max(limit_m, 0.0):.1f} mm that a camera "
        f"sees from {1e3 * camera.height_m:.0f} mm with a lens of {camera.focal_length_mm:g} mm"
    )


def _lamp_fault(geometry: SettledGeometry) -> str | None:
    for lamp in geometry.scene.lamps:
        for curve, cable in zip(geometry.curves, geometry.scene.cables, strict=True):
            if float(distances_m(lamp, curve).min()) < cable.diameter_m / 2:
                return f"a cable lies in a {lamp.kind} lamp"
    return None


def distances_m(lamp: Lamp, points: Points) -> NDArray[np.float64]:
    """Compute the distance of points (N, 3) from a lamp's surface or inside, (N,) metres; inf for an area light.

    An area light's height and size are the template's, which stands beside the cables.
    """
    if isinstance(lamp, AreaLamp):
        return np.full(len(points), np.inf)
    bearing = np.radians(lamp.bearing_deg)
    if isinstance(lamp, StudioLamp):
        elevation = np.radians(lamp.elevation_deg)
        level = np.cos(elevation)
        towards = np.array([level * np.cos(bearing), level * np.sin(bearing), np.sin(elevation)])
        from_middle = points - lamp.distance_m * towards
        off_plane = from_middle @ towards
        across = np.linalg.norm(from_middle - off_plane[:, None] * towards, axis=1)
        from_disc: NDArray[np.float64] = np.hypot(off_plane, np.maximum(across - lamp.size_m / 2, 0.0))
        return from_disc
    middle = np.array([lamp.radius_m * np.cos(bearing), lamp.radius_m * np.sin(bearing), lamp.height_m])
    from_sphere: NDArray[np.float64] = np.maximum(np.linalg.norm(points - middle, axis=1) - lamp.size_m, 0.0)
    return from_sphere
