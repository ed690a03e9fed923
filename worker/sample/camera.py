"""Samples the camera, its lens, and the development of the light on its sensor."""

import numpy as np

from farm.scene.camera import FOCAL_LENGTH_MM, NO_JPEG, Camera, Development
from farm.spec.ranges.camera import CameraRanges, DevelopmentRanges
from worker.sample.values import chance, level, log_uniform, pattern_seed, uniform


def sample_camera(ranges: CameraRanges, rng: np.random.Generator) -> Camera:
    """Sample the camera; with every lens it stands at the distance that keeps the picture's width on the floor.

    Args:
        ranges: ranges of the style.
        rng: random generator of the camera.
    """
    height = ranges.heights_m[int(rng.integers(len(ranges.heights_m)))]
    focal_length = ranges.focal_lengths_mm[int(rng.integers(len(ranges.focal_lengths_mm)))]
    distance = height * focal_length / FOCAL_LENGTH_MM
    return Camera(
        height_m=distance,
        f_number=log_uniform(rng, ranges.f_number),
        focal_length_mm=focal_length,
        tilt_deg=uniform(rng, ranges.tilt_deg),
        tilt_bearing_deg=float(rng.uniform(0.0, 360.0)) if ranges.tilt_deg[1] else 0.0,
        roll_deg=uniform(rng, ranges.roll_deg),
        focus_offset_m=uniform(rng, ranges.focus_offset_share) * distance,
        distortion=uniform(rng, ranges.distortion),
    )


def sample_development(
    ranges: DevelopmentRanges, rng: np.random.Generator, *, over_light_floor: bool
) -> Development | None:
    """Sample the settings that turn light on the sensor into a picture.

    Args:
        ranges: ranges of the style.
        rng: random generator of the development.
        over_light_floor: whether the floor is a light one, over which some pictures are exposed more.

    Returns:
        The settings; None for a picture that Blender's view transform develops.
    """
    if not chance(rng, ranges.share):
        return None
    noisy, compressed = chance(rng, ranges.noise_share), chance(rng, ranges.jpeg_share)
    full_well, quality = log_uniform(rng, ranges.full_well), level(rng, ranges.jpeg_quality)
    red, blue = (2.0 ** uniform(rng, ranges.white_balance_ev) for _ in range(2))
    read_noise = uniform(rng, ranges.read_noise)
    developed = Development(
        key=log_uniform(rng, ranges.key),
        exposure_ev=uniform(rng, ranges.exposure_ev),
        contrast=uniform(rng, ranges.contrast),
        saturation=uniform(rng, ranges.saturation),
        white_balance=(red, blue),
        vignetting=uniform(rng, ranges.vignetting),
        chromatic_aberration=uniform(rng, ranges.chromatic_aberration),
        full_well=full_well if noisy else 0.0,
        read_noise=read_noise if noisy else 0.0,
        sharpening=uniform(rng, ranges.sharpening),
        jpeg_quality=quality if compressed else NO_JPEG,
        seed=pattern_seed(rng),
    )
    opened, more_ev = chance(rng, ranges.light_floor_share), uniform(rng, ranges.light_floor_ev)
    if not (opened and over_light_floor):
        return developed
    return developed.model_copy(update={"exposure_ev": min(developed.exposure_ev + more_ev, ranges.most_ev)})
