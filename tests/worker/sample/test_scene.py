"""Sampling scenes: within the ranges, and from the job's own streams alone."""

from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.scene.light import AreaLamp, PointLamp
from farm.scene.scene import Scene
from farm.spec.category import Background, Category, Light
from farm.spec.ranges.all import Ranges
from tests.worker.scenes import make_scene

RANGES = Ranges()


def many(category: Category, count: int = 60) -> Iterator[Scene]:
    """Scenes of the first jobs of a category."""
    return (make_scene(category, index) for index in range(count))


def within(value: float, bounds: tuple[float, float]) -> bool:
    """Whether a drawn value lies in its range."""
    return bounds[0] <= value <= bounds[1]


@given(category=st.sampled_from(Category), index=st.integers(0, 10**6), seed=st.integers(0, 2**64 - 1))
def test_the_same_job_gives_the_same_scene(category: Category, index: int, seed: int) -> None:
    """The dataset's seed, even 0, the category and the index alone decide a scene."""
    assert make_scene(category, index, seed=seed) == make_scene(category, index, seed=seed)


def test_another_seed_job_or_attempt_gives_another_scene() -> None:
    """Streams of different jobs, seeds and attempts differ."""
    scenes = [make_scene(index=0), make_scene(index=1), make_scene(index=0, attempt=1), make_scene(index=0, seed=1)]
    cables = [scene.cables[0] for scene in scenes]
    assert len({cable.model_dump_json() for cable in cables}) == len(scenes)


def test_a_range_of_one_stage_leaves_the_draws_of_the_others() -> None:
    """Another range of the wind moves neither the cables nor the camera, as each stage has its own stream."""
    calm = make_scene(ranges={"wind": {"strength": [0.0, 0.0]}})
    windy = make_scene()
    assert calm.wind != windy.wind
    assert (calm.cables, calm.camera, calm.hdri_world) == (windy.cables, windy.camera, windy.hdri_world)


@pytest.mark.parametrize("category", Category)
def test_a_category_fixes_floor_lamp_and_hdri(category: Category) -> None:
    """A floor is drawn where it is seen, and exactly one of lamp and HDRI lights a scene."""
    traits = category.traits
    for scene in many(category, 10):
        assert (scene.floor is not None) == (traits.background is Background.FLOOR)
        assert bool(scene.lamps) == (traits.light is Light.CONCENTRATED)
        assert (scene.hdri_world is None) == bool(scene.lamps)


@pytest.mark.parametrize("category", Category)
def test_a_picture_without_cables_is_as_it_would_be_with_them(category: Category) -> None:
    """Floor, clutter, light, camera and all else are drawn from streams that the missing cables do not move.

    A peg is there for the cables that run round it, and takes the place of sticks.
    """
    for index in range(10):
        with_cables = make_scene(category, index, style="wide")
        if with_cables.pegs:
            continue
        without = make_scene(category, index, style="wide", ranges={"cable": {"background_share": 1.0}})
        assert without.cables == ()
        assert without == with_cables.model_copy(update={"cables": ()})


def test_a_share_of_the_jobs_has_no_cables_at_any_attempt() -> None:
    """About the share asked for; the other jobs' scenes are those of a dataset without such pictures."""
    some = {"cable": {"background_share": 0.3}}
    bare = [index for index in range(300) if not make_scene(index=index, ranges=some).cables]
    assert 60 < len(bare) < 120
    assert not any(make_scene(index=index, attempt=attempt, ranges=some).cables for index in bare for attempt in (1, 2))
    others = [index for index in range(20) if index not in bare]
    assert all(make_scene(index=index, ranges=some) == make_scene(index=index) for index in others)


def test_one_to_eight_cables_are_drawn_and_each_number_occurs() -> None:
    """The published numbers 1 to 8 all occur."""
    assert {len(scene.cables) for scene in many(Category.FAR, 600)} == set(range(1, 9))


def test_free_cables_lie_in_the_published_ranges() -> None:
    """Cables that aren't aligned have x, y, rotation and vertex mass in the published ranges."""
    for scene in many(Category.FAR):
        assert within(scene.vertex_mass, RANGES.cable.vertex_mass)
        for cable in scene.cables:
            assert within(cable.x_m, RANGES.placement.free_x_m)
            assert within(cable.y_m, RANGES.placement.free_y_m)
            assert within(cable.rotation_deg, RANGES.placement.free_rotation_deg)


def test_aligned_cables_keep_within_ten_degrees_of_one_bearing() -> None:
    """Two cables of an aligned picture differ by at most 20 degrees."""
    for scene in many(Category.FAR_ALIGNED):
        bearings = [cable.rotation_deg for cable in scene.cables]
        assert max(bearings) - min(bearings) <= 20.0
        for cable in scene.cables:
            assert within(cable.x_m, RANGES.placement.aligned_x_m)
            assert within(cable.y_m, RANGES.placement.aligned_y_m)


def test_cables_start_at_stacked_heights() -> None:
    """Each cable starts `spacing_m` above the one before."""
    scene = next(scene for scene in many(Category.FAR) if len(scene.cables) > 3)
    heights = [cable.start_height_m for cable in scene.cables]
    assert heights == [
        RANGES.placement.drop_height_m + level * RANGES.placement.spacing_m for level in range(len(heights))
    ]


def test_wind_flows_at_a_fifth_of_its_strength() -> None:
    """The wind has the published flow."""
    for scene in many(Category.FAR, 20):
        assert scene.wind.flow == pytest.approx(scene.wind.strength / 5)


def test_both_lamps_occur_and_lie_in_their_ranges() -> None:
    """Half of the lamps are points and half areas, which stand to either side."""
    lamps = [scene.lamps[0] for scene in many(Category.CLOSE_CONCENTRATED, 100)]
    areas = [lamp for lamp in lamps if isinstance(lamp, AreaLamp)]
    points = [lamp for lamp in lamps if isinstance(lamp, PointLamp)]
    assert {area.x_m > 0 for area in areas} == {True, False}
    assert all(4.0 <= abs(area.x_m) <= 15.0 and 400.0 <= area.power_w <= 1800.0 for area in areas)
    assert points
    assert all(5.0 <= point.radius_m <= 6.5 and 800.0 <= point.power_w <= 1500.0 for point in points)


def test_all_eleven_camera_heights_occur() -> None:
    """The published heights all occur, which give cables of 4 to 16 pixels."""
    heights = {scene.camera.height_m for scene in many(Category.FAR, 200)}
    assert heights == set(RANGES.camera.heights_m)
    widths = sorted(512 * 50 / 36 * 0.002 / height for height in heights)
    assert widths[0] == pytest.approx(4.3, abs=0.05)
    assert widths[-1] == pytest.approx(15.8, abs=0.05)


def test_only_dark_hdris_are_brightened() -> None:
    """The dark HDRI's brightness is drawn, and the other one's is 0."""
    for scene in many(Category.FAR):
        assert scene.hdri_world is not None
        if scene.hdri_world.hdri == "night":
            assert 0.10 <= scene.hdri_world.brightness <= 0.60
        else:
            assert scene.hdri_world.brightness == 0.0


def test_far_pictures_look_at_the_horizon_upright() -> None:
    """The HDRI is tilted by 90 degrees in every far picture."""
    assert {scene.hdri_world.tilt_deg for scene in many(Category.FAR, 30) if scene.hdri_world} == {90.0}


def test_close_pictures_without_a_lamp_share_one_hdri() -> None:
    """The named HDRI lights all of them, tilted by 0 or 90 degrees."""
    scenes = [
        make_scene(Category.CLOSE_DISTRIBUTED, index, close_distributed_hdri="night").hdri_world for index in range(30)
    ]
    assert {world.hdri for world in scenes if world} == {"night"}
    assert {world.tilt_deg for world in scenes if world} == {0.0, 90.0}


@pytest.mark.parametrize("category", Category)
@pytest.mark.parametrize(("resolution", "across", "along"), [("512x384", 1.0, 0.75), ("128x512", 0.25, 1.0)])
def test_the_shape_of_the_picture_decides_only_where_clutter_lies(
    category: Category, resolution: str, across: float, along: float
) -> None:
    """Cables, camera, floor and light are those of the square picture; clutter lies in what the picture shows.

    So do tangles, of which these pictures have none.
    """
    kinds = ("heap", "knot", "threaded", "crossed_bundles", "peg")
    tangle = {f"{kind}_share": 0.0 for kind in kinds}
    cluttered = {"clutter": {"share": 1.0}, "placement": {"tangle": tangle}}
    clutter = {"sticks", "sheets", "parts"}
    for index in range(10):
        square = make_scene(category, index, style="wide", ranges=cluttered, resolution=512)
        oblong = make_scene(category, index, style="wide", ranges=cluttered, resolution=resolution)
        # Cables start above the sticks, which are thinner in a narrow picture.
        other: dict[str, Any] = {**dict.fromkeys(clutter, True), "cables": {"__all__": {"start_height_m"}}}
        assert oblong.model_dump(exclude=other) == square.model_dump(exclude=other)
        for kind in clutter:
            for thing, same in zip(getattr(oblong, kind), getattr(square, kind), strict=True):
                assert thing.x_m == pytest.approx(across * same.x_m)
                assert thing.y_m == pytest.approx(along * same.y_m)
        assert all(stick.diameter_m <= 0.1 * min(across, along) * oblong.camera.seen_m for stick in oblong.sticks)
