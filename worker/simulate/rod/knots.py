"""Ties a knot in a cable and pulls it tight, before the cable falls. A stub until the module of that name is merged."""

from farm.scene.cable import Cable
from worker.simulate.rod.model import Rod


def tie(cable: Cable, segment_radii: float) -> Rod:
    """Tie the knot of `cable` and pull it; return the cable as a rod.

    Args:
        cable: cable with a knot.
        segment_radii: length of the segments of most rods, in radii.

    Returns:
        The rod, level about the origin: the middle of its chord at the origin, the chord along +x, the lowest underside
        of the tube at z = 0, its natural curvature set.
    """
    raise NotImplementedError("knots are not tied yet")
