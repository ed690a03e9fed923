"""Lamps and grey surroundings are as bright as drawn, and leave nothing behind."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

bpy = pytest.importorskip("bpy")

from blend import names  # noqa: E402  # after importorskip
from blend.build import TEMPLATE  # noqa: E402
from blend.contract import open_template  # noqa: E402
from farm.scene.camera import Camera  # noqa: E402
from farm.scene.light import AreaLamp, GreyWorld, StudioLamp  # noqa: E402
from farm.scene.picture_size import PictureSize  # noqa: E402
from farm.spec.rendering import CyclesSettings, Denoiser, PictureSettings  # noqa: E402
from worker.blender.camera import set_camera  # noqa: E402
from worker.blender.render import configure_cycles, configure_picture, render_picture  # noqa: E402
from worker.blender.world import set_grey_world, set_lamps  # noqa: E402
from worker.camera.black_body import black_body  # noqa: E402
from worker.camera.view import View  # noqa: E402

pytestmark = pytest.mark.blender

BLACK = GreyWorld(radiance=0.0, temperature_k=6500.0)
RESOLUTION = 32


LAMP = StudioLamp(
    bearing_deg=30.0,
    elevation_deg=90.0,
    distance_m=2.0,
    irradiance_w_m2=math.pi / 2,
    size_m=0.2,
    temperature_k=6500.0,
)
"""Lamp straight above the floor that gives it a radiance of one half."""


def lamp(**changes: float) -> StudioLamp:
    """The lamp above with some changes."""
    return LAMP.model_copy(update=changes)


@pytest.fixture(autouse=True)
def white_floor() -> None:
    """A white Lambertian floor in a fresh template, seen from above through a view transform that changes nothing."""
    open_template(TEMPLATE)
    tree = bpy.data.materials[names.FLOOR].node_tree
    white = tree.nodes.new("ShaderNodeBsdfDiffuse")
    white.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(white.outputs["BSDF"], output.inputs["Surface"])
    bpy.data.objects[names.CABLE].hide_render = True
    camera = Camera(height_m=0.1, f_number=8.0)
    set_camera(camera, View.of(camera, PictureSize.square(RESOLUTION)))
    scene = configure_picture(PictureSize.square(RESOLUTION), 0)
    scene.view_settings.view_transform = "Raw"
    settings = PictureSettings(cycles=CyclesSettings(samples=64, denoiser=Denoiser.NONE, diffuse_bounces=0))
    configure_cycles(scene, settings, "cpu", 0)


def radiance() -> NDArray[np.float64]:
    """The radiance of the floor, (3,), 0 to 1."""
    colour: NDArray[np.float64] = render_picture().mean(axis=(0, 1)) / 255.0
    return colour


@pytest.mark.parametrize(
    "changes", [{}, {"size_m": 1.2, "distance_m": 0.8}, {"elevation_deg": 35.0, "irradiance_w_m2": 2.5}]
)
def test_a_lamp_has_its_irradiance(changes: dict[str, float]) -> None:
    """A white floor has the radiance E sin(elevation) / pi, however large and near the lamp, within 2 %."""
    wanted = lamp(**changes)
    set_lamps((wanted,))
    set_grey_world(BLACK)
    expected = wanted.irradiance_w_m2 * math.sin(math.radians(wanted.elevation_deg)) / math.pi
    assert radiance() == pytest.approx(expected * black_body(6500.0), rel=0.02)


def test_lamps_add_up_and_go_with_their_picture() -> None:
    """Two lamps of different colours add up, and a later picture has none of them."""
    warm, cold = lamp(irradiance_w_m2=0.8, temperature_k=3000.0), lamp(irradiance_w_m2=0.6, bearing_deg=200.0)
    set_grey_world(BLACK)
    set_lamps((warm, cold))
    expected = (0.8 * black_body(3000.0) + 0.6 * black_body(6500.0)) / math.pi
    assert radiance() == pytest.approx(expected, rel=0.02, abs=0.003)
    set_lamps(())
    assert not radiance().any()
    assert not [light for light in bpy.data.lights if light.name.startswith("studio")]


def test_a_lamp_between_camera_and_floor_is_not_seen() -> None:
    """A lamp between camera and floor lights the floor and hides nothing."""
    set_grey_world(BLACK)
    set_lamps((lamp(distance_m=0.05, size_m=0.05),))
    assert radiance().min() > 0.2


def test_grey_surroundings_are_as_bright_and_warm_as_drawn() -> None:
    """An even world of radiance L gives a white floor the radiance L."""
    set_lamps(())
    set_grey_world(GreyWorld(radiance=0.4, temperature_k=5000.0))
    assert radiance() == pytest.approx(0.4 * black_body(5000.0), rel=0.02)


def test_the_templates_grey_comes_back() -> None:
    """After an image with another grey, the template's comes back to the last bit, be it an artist's or the farm's."""
    node = bpy.data.worlds[names.WORLD].node_tree.nodes[names.WORLD_GREY]
    node.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1.0)
    node.inputs["Strength"].default_value = 0.7
    before = (*node.inputs["Color"].default_value, node.inputs["Strength"].default_value)
    for grey in (BLACK, GreyWorld(radiance=2.0, temperature_k=3000.0), None):
        set_grey_world(grey)
    assert (*node.inputs["Color"].default_value, node.inputs["Strength"].default_value) == before


def test_the_published_lamp_is_off_beside_others() -> None:
    """The published lamp is off beside other lamps, and on again when it is drawn."""
    set_lamps((lamp(),))
    assert bpy.data.objects[names.AREA_LAMP].hide_render
    set_lamps((AreaLamp(x_m=4.0, power_w=500.0),))
    assert not bpy.data.objects[names.AREA_LAMP].hide_render
