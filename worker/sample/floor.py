"""Samples the floor: its texture, the texture's position, and its wear."""

import numpy as np

from farm.scene.floor import Floor, JointFill, Wear
from farm.spec.header import DatasetHeader
from farm.spec.ranges.floor import FloorRanges, WearRanges
from worker.sample.values import chance, log_uniform, pattern_seed, uniform


def sample_floor(
    ranges: FloorRanges, header: DatasetHeader, rng: np.random.Generator, wear_rng: np.random.Generator
) -> Floor:
    """Sample the floor's surface, its position and its wear.

    Args:
        ranges: ranges of the style.
        header: header of the dataset, with its surfaces.
        rng: random generator of the floor.
        wear_rng: random generator of the wear, and of the choice of a light surface.
    """
    drawn = header.surfaces[int(rng.integers(len(header.surfaces)))]
    light = [surface for surface in header.surfaces if surface.light] or list(header.surfaces)
    lighter = light[int(wear_rng.integers(len(light)))]
    return Floor(
        texture=(lighter if chance(wear_rng, ranges.light_share) else drawn).name,
        offset_x=uniform(rng, ranges.offset_x),
        offset_y=uniform(rng, ranges.offset_y),
        rotation_deg=uniform(rng, ranges.rotation_deg),
        scale=uniform(rng, ranges.scale),
        wear=_sample_wear(ranges.wear, wear_rng),
    )


def _sample_wear(ranges: WearRanges, rng: np.random.Generator) -> Wear | None:
    if not chance(rng, ranges.share):
        return None
    stained, scratched, dusty = (
        chance(rng, share) for share in (ranges.stained_share, ranges.scratched_share, ranges.dusty_share)
    )
    stains, scratches, dust = (
        uniform(rng, ranges.stains),
        uniform(rng, ranges.scratches),
        uniform(rng, ranges.dust),
    )
    red, green, blue = (2.0 ** uniform(rng, ranges.tint_ev) for _ in range(3))
    worn = Wear(
        brightness=2.0 ** uniform(rng, ranges.brightness_ev),
        tint=(red, green, blue),
        saturation=uniform(rng, ranges.saturation),
        contrast=uniform(rng, ranges.contrast),
        stains=stains if stained else 0.0,
        scratches=scratches if scratched else 0.0,
        dust=dust if dusty else 0.0,
        mirrored=chance(rng, 0.5),
        pattern_seed=pattern_seed(rng),
    )
    # The filling is sampled last, and always, so that it changes no other random value.
    joints = _sample_joint_fill(ranges, rng)
    return worn.model_copy(update={"joints": joints}) if chance(rng, ranges.refilled_share) else worn


def _sample_joint_fill(ranges: WearRanges, rng: np.random.Generator) -> JointFill:
    level, warmth = log_uniform(rng, ranges.joint_albedo), uniform(rng, ranges.joint_warmth_ev)
    return JointFill(
        albedo=(min(1.0, level * 2.0**warmth), level, min(1.0, level / 2.0**warmth)),
        cover=uniform(rng, ranges.joint_cover),
        spread_m=uniform(rng, ranges.joint_spread_m),
    )
