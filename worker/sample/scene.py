"""Samples a scene: every random value of a picture, from the job's random streams, one for each stage."""

import numpy as np

from farm.scene.floor import Floor
from farm.scene.physics import Friction
from farm.scene.scene import Scene
from farm.spec.category import Background, Light
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.ranges.cable import CableRanges
from worker.sample.backdrop import sample_plate, sample_world
from worker.sample.cable import sample_cables, sample_substances
from worker.sample.camera import sample_camera, sample_development
from worker.sample.clutter import is_clear_of_peg, sample_parts, sample_sheets, sample_sticks
from worker.sample.floor import sample_floor
from worker.sample.light import NO_LAMPS, sample_lamps
from worker.sample.seeds import Stage, generator
from worker.sample.tangle import Tangled, sample_kind, tangle
from worker.sample.values import chance, level, uniform
from worker.sample.wind import sample_wind


def sample_scene(header: DatasetHeader, job: Job, attempt: int) -> Scene:
    """Sample the scene of one attempt at a job.

    The same header, job and attempt give the same scene on every machine.

    Args:
        header: header of the dataset.
        job: job, whose category decides background, light and disposition.
        attempt: number of the attempt, from 0.
    """

    def streams(stage: Stage) -> np.random.Generator:
        return generator(header.spec.seed, job.category, job.index, attempt, stage)

    ranges, traits = header.spec.ranges, job.category.traits
    is_background = _is_background(header, job)
    counts = streams(Stage.CABLES)
    count = _sample_count(ranges.cable, counts)
    vertex_mass = uniform(counts, ranges.cable.vertex_mass)
    friction = Friction(
        floor=uniform(counts, ranges.cable.friction_floor), cable=uniform(counts, ranges.cable.friction_cable)
    )
    substances = sample_substances(ranges.cable, count, counts)
    camera = sample_camera(ranges.camera, streams(Stage.CAMERA))
    across, along = header.spec.resolution.shares
    seen_m = (across * camera.seen_m, along * camera.seen_m)
    is_floor = traits.background is Background.FLOOR
    clutter_rng = streams(Stage.CLUTTER)
    cluttered = chance(clutter_rng, ranges.clutter.share) and is_floor
    sticks = sample_sticks(ranges.clutter, seen_m, clutter_rng) if cluttered else ()
    is_lamp = traits.light is Light.CONCENTRATED
    lighting = sample_lamps(ranges.lamp, ranges.studio, streams(Stage.LIGHT)) if is_lamp else NO_LAMPS
    floor = sample_floor(ranges.floor, header, streams(Stage.FLOOR), streams(Stage.WEAR)) if is_floor else None
    above = max((stick.start_height_m + 1.5 * stick.diameter_m for stick in sticks), default=0.0)
    lowest_m = max(ranges.placement.drop_height_m, above)
    tangled = Tangled(())
    if not is_background:
        cables = sample_cables(
            ranges,
            traits.disposition,
            substances,
            camera,
            streams,
            length_m=ranges.cable.length_m if is_floor else ranges.cable.far_length_m or ranges.cable.length_m,
            lowest_m=lowest_m,
        )
        tangle_rng = streams(Stage.TANGLE)
        kind = sample_kind(ranges.placement.tangle, traits, tangle_rng)
        tangled = tangle(kind, ranges.placement.tangle, cables, camera, min(seen_m), tangle_rng, lowest_m=lowest_m)
    return Scene(
        attempt=attempt,
        cables=tangled.cables,
        vertex_mass=vertex_mass,
        friction=friction,
        wind=sample_wind(ranges.wind, streams(Stage.WIND)),
        floor=floor,
        lamps=lighting.lamps,
        grey_world=lighting.grey_world,
        hdri_world=None if lighting.lamps else sample_world(header, traits.background, streams(Stage.WORLD)),
        plate=None if is_floor else sample_plate(header, streams(Stage.PLATE)),
        sticks=tuple(stick for stick in sticks if all(is_clear_of_peg(stick, peg) for peg in tangled.pegs)),
        pegs=tangled.pegs,
        sheets=sample_sheets(ranges.clutter, seen_m, clutter_rng) if cluttered else (),
        parts=sample_parts(ranges.clutter, seen_m, clutter_rng) if cluttered else (),
        camera=camera,
        development=sample_development(
            ranges.development, streams(Stage.DEVELOPMENT), over_light_floor=_is_light(header, floor)
        ),
        render_seed=int(streams(Stage.RENDER).integers(2**31)),
    )


def _is_background(header: DatasetHeader, job: Job) -> bool:
    """Draw whether a job's picture has no cable: once for all attempts, as no background is ever drawn again."""
    rng = generator(header.spec.seed, job.category, job.index, 0, Stage.BACKGROUND)
    return chance(rng, header.spec.ranges.cable.background_share)


def _is_light(header: DatasetHeader, floor: Floor | None) -> bool:
    return floor is not None and any(surface.light for surface in header.surfaces if surface.name == floor.texture)


def _sample_count(ranges: CableRanges, rng: np.random.Generator) -> int:
    return max(level(rng, ranges.count) for _ in range(ranges.count_draws))
