"""The camera's aperture, and how far it blurs what is out of focus."""

from farm.scene.camera import Camera
from worker.camera.view import View


def lens_radius_m(camera: Camera) -> float:
    """Radius of the lens's aperture in metres: half the focal length over the f-number."""
    return 0.5e-3 * camera.focal_length_mm / camera.f_number


def blur_px_per_m(view: View, highest_m: float) -> float:
    """Pixels by which a point that is most out of focus moves for each metre on the lens.

    Args:
        view: the camera.
        highest_m: height of the highest point above the floor.
    """
    floor_m = view.depths_m(view.floor_corners_m())
    # Along a line of sight depth falls as height rises. A cable that reaches up to the camera has no picture.
    nearest_m = max(floor_m.min() * (1.0 - highest_m / view.position_m[2]), 1e-6)
    blur = max(view.focus_m / nearest_m - 1.0, 1.0 - view.focus_m / floor_m.max())
    return float(blur * view.focal_length_px / view.focus_m)
