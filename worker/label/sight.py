"""Whether a picture shows enough of its cables, judged by its mask before anything is rendered."""

import numpy as np
from numpy.typing import NDArray

from farm.scene.scene import Scene


def find_sight_fault(scene: Scene, mask: NDArray[np.uint8], least_share: float) -> str | None:
    """Find the reason why a scene must be drawn again; None if its picture shows enough of its cables, or it has none.

    Args:
        scene: the scene as drawn.
        mask: (H, W) mask of the picture, lens and all.
        least_share: least share of the pixels that show a cable, 0 to 1.
    """
    share = np.count_nonzero(mask) / mask.size
    if scene.cables and share < least_share:
        return f"cables are seen in {share:.2%} of the picture, less than {least_share:.2%} (least_visible_share)"
    return None
