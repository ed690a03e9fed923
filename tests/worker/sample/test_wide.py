"""Scenes of the wide style."""

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from farm.scene.clutter import PartKind, SheetKind, StickKind
from farm.scene.light import StudioLamp
from farm.scene.scene import Scene
from farm.spec.category import Background, Category, Light
from farm.spec.header import BuiltinSurfaceRef
from farm.spec.job import Job
from tests.worker.scenes import make_header, make_scene
from worker.sample.scene import sample_scene


def wide(category: Category, index: int) -> Scene:
    """A scene of the wide style."""
    return make_scene(category, index, style="wide")


@given(category=st.sampled_from(Category), index=st.integers(0, 10**6))
@settings(max_examples=200, deadline=None)
def test_nothing_starts_inside_anything_else(category: Category, index: int) -> None:
    """Each cable starts above everything that starts below it, sticks first; `test_tangle` tells of woven cables."""
    scene = wide(category, index)
    assume(not any(cable.heights_m for cable in scene.cables))
    top = 0.0
    for stick in scene.sticks:
        assert stick.start_height_m >= top
        top = stick.start_height_m + stick.diameter_m
    for cable in scene.cables:
        assert cable.start_height_m >= top
        top = cable.start_height_m + cable.rise_m + cable.diameter_m


@pytest.mark.parametrize("category", Category)
def test_clutter_lies_on_floors_alone(category: Category) -> None:
    """In pictures without a visible floor there is no clutter, which would float."""
    scenes = [wide(category, index) for index in range(40)]
    has_any = any(scene.sticks or scene.sheets or scene.parts for scene in scenes)
    assert has_any == (category.traits.background is Background.FLOOR)


def test_every_kind_of_clutter_occurs() -> None:
    """Every kind occurs within 400 pictures."""
    scenes = [wide(Category.CLOSE_CONCENTRATED, index) for index in range(400)]
    assert {stick.kind for scene in scenes for stick in scene.sticks} == set(StickKind)
    assert {sheet.kind for scene in scenes for sheet in scene.sheets} == set(SheetKind)
    assert {part.kind for scene in scenes for part in scene.parts} == set(PartKind)


def test_lamps_vary_in_number_size_and_colour() -> None:
    """There are one to three lamps, hard to soft and warm to cold, and some pictures have the published lamp."""
    scenes = [wide(Category.CLOSE_CONCENTRATED, index) for index in range(200)]
    studio = [[lamp for lamp in scene.lamps if isinstance(lamp, StudioLamp)] for scene in scenes]
    assert {len(lamps) for lamps in studio} == {0, 1, 2, 3}
    sizes = [lamp.size_m / lamp.distance_m for lamps in studio for lamp in lamps]
    warmth = [lamp.temperature_k for lamps in studio for lamp in lamps]
    assert min(sizes) < 0.03
    assert max(sizes) > 0.4
    assert min(warmth) < 3000
    assert max(warmth) > 7000
    assert all((scene.grey_world is not None) == bool(lamps) for scene, lamps in zip(scenes, studio, strict=True))


def test_light_floors_are_exposed_for_light() -> None:
    """Light floors add the range's stops to the exposure, up to the limit of all pictures."""
    development = {"exposure_ev": [0.0, 1.0], "light_floor_ev": [1.2, 1.2], "light_floor_share": 1.0}
    ranges = {"development": development, "floor": {"light_share": 0.5}}
    surfaces = tuple(
        BuiltinSurfaceRef(name=name, recipe_version=1, light=name == "whiteboard") for name in ("whiteboard", "soil")
    )
    header = make_header(style="wide", ranges=ranges).model_copy(update={"surfaces": surfaces})
    found: dict[bool, list[float]] = {True: [], False: []}
    for index in range(60):
        scene = sample_scene(header, Job(category=Category.CLOSE_CONCENTRATED, index=index), 0)
        assert scene.floor is not None
        assert scene.development is not None
        found[scene.floor.texture == "whiteboard"].append(scene.development.exposure_ev)
    assert set(found[True]) == {1.2}
    assert all(0.0 <= exposure_ev <= 1.0 for exposure_ev in found[False])
    assert len(found[False]) > 10


def test_a_longer_lens_stands_farther_away() -> None:
    """With a longer lens the picture is as wide as with the published one."""
    widths = {
        round(scene.camera.height_m / scene.camera.focal_length_mm * 50, 6)
        for scene in (wide(Category.FAR, index) for index in range(200))
    }
    assert widths <= {0.09, 0.12, 0.15, 0.18, 0.22, 0.27, 0.33, 0.40, 0.50}


@pytest.mark.parametrize("category", Category)
def test_a_wide_scene_is_lit_by_lamps_or_by_an_hdri(category: Category) -> None:
    """The category decides between lamps and an HDRI."""
    for index in range(10):
        scene = wide(category, index)
        assert bool(scene.lamps) == (category.traits.light is Light.CONCENTRATED)
        assert (scene.hdri_world is None) == bool(scene.lamps)
