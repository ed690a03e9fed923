"""The camera's aperture."""

from farm.scene.camera import Camera


def lens_radius_m(camera: Camera) -> float:
    """Radius of the lens's aperture in metres: half the focal length over the f-number."""
    return 0.5e-3 * camera.focal_length_mm / camera.f_number
