"""Clutter in a real Blender: it is visible, leaves labels alone, and is gone from the next picture."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

bpy = pytest.importorskip("bpy")

from assets.surfaces.bake import bake_surfaces  # noqa: E402  # after importorskip
from farm.cli.installed_assets import InstalledAssets  # noqa: E402
from farm.run.worker_settings import DeviceChoice, RendererSettings  # noqa: E402
from farm.scene.clutter import PartKind, SheetKind, StickKind  # noqa: E402
from farm.scene.floor import Wear  # noqa: E402
from farm.scene.picture_size import PictureSize  # noqa: E402
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.category import Category  # noqa: E402
from farm.spec.header import DatasetHeader  # noqa: E402
from farm.spec.job import Job  # noqa: E402
from farm.spec.make_header import Inputs  # noqa: E402
from farm.spec.make_header import make_header as catalogue_header  # noqa: E402
from farm.spec.parse import parse_spec  # noqa: E402
from farm.spec.rendering import CyclesSettings, Denoiser, PictureSettings  # noqa: E402
from tests.worker.clutter.things import make_part, make_sheet, make_stick  # noqa: E402
from worker.blender.clutter import PREFIX  # noqa: E402
from worker.blender.renderer import open_renderer  # noqa: E402
from worker.geometry import SettledGeometry  # noqa: E402
from worker.sample.scene import sample_scene  # noqa: E402
from worker.simulate.simulate import simulate  # noqa: E402

pytestmark = pytest.mark.blender

RESOLUTION = PictureSize.square(96)
NEUTRAL = Wear(
    brightness=1.0,
    tint=(1.0, 1.0, 1.0),
    saturation=1.0,
    contrast=1.0,
    stains=0.0,
    scratches=0.0,
    dust=0.0,
    mirrored=False,
    pattern_seed=0,
)


class Stage:
    """An open renderer with one small surface."""

    def __init__(self, folder: Path) -> None:
        bake_surfaces(folder, pixels=256, names=("concrete_smooth",), processes=1)
        spec = parse_spec({"seed": 0, "images": 60, "style": "published"}, source="test")
        made: DatasetHeader = catalogue_header(spec, Inputs(environments=False), InstalledAssets())
        self.header = made.model_copy(
            update={"surfaces": tuple(each for each in made.surfaces if each.name == "concrete_smooth")}
        )
        self._renderer = open_renderer(self.header, RendererSettings(device=DeviceChoice.CPU, threads=1, assets=folder))
        self.job = Job(category=Category.CLOSE_CONCENTRATED, index=0)
        self.plain = sample_scene(self.header, self.job, 0)

    def picture(self, scene: Scene) -> NDArray[np.uint8]:
        """Fallen and rendered."""
        shapes = simulate(scene, self.header.spec.simulator, self.header.spec.fall)
        settings = PictureSettings(cycles=CyclesSettings(samples=4, denoiser=Denoiser.NONE))
        geometry = SettledGeometry(scene, shapes, settings.detail, RESOLUTION)
        built = self._renderer.build(geometry, settings.economy)
        self._renderer.use_cycles(settings, RESOLUTION, seed=0)
        return self._renderer.render(built)


@pytest.fixture(scope="module")
def stage(tmp_path_factory: pytest.TempPathFactory) -> Stage:
    """A stage that all tests share; each renders its own scenes."""
    return Stage(tmp_path_factory.mktemp("surfaces"))


def cluttered(plain: Scene) -> Scene:
    """A scene with clutter of each kind in view of the camera, and cables that start above the sticks."""
    edge = 0.012
    return plain.model_copy(
        update={
            "cables": tuple(
                cable.model_copy(update={"start_height_m": cable.start_height_m + 0.08}) for cable in plain.cables
            ),
            "sticks": tuple(
                make_stick(kind, x_m=edge * (k - 2), start_height_m=0.001 + 0.015 * k, rotation_deg=30.0 * k)
                for k, kind in enumerate(StickKind)
            ),
            "sheets": tuple(make_sheet(kind, y_m=edge * (k - 4), seed=k) for k, kind in enumerate(SheetKind)),
            "parts": tuple(make_part(kind, x_m=0.2, y_m=0.05 * k) for k, kind in enumerate(PartKind)),
        }
    )


def test_every_kind_of_clutter_is_put_in_the_picture(stage: Stage) -> None:
    """Each piece of clutter is an object above the floor; a sheet lies less than a tenth of a millimetre above it."""
    scene = cluttered(stage.plain)
    stage.picture(scene)
    found = [each for each in bpy.data.scenes["picture"].objects if each.name.startswith(f"{PREFIX}.")]
    assert len(found) == len(scene.sticks) + len(scene.sheets) + len(scene.parts)
    for each in found:
        heights = [vertex.co.z for vertex in each.data.vertices]
        assert min(heights) >= -1e-6
        if "sheet" in each.name:
            assert 0 < max(heights) < 1e-4


def test_a_picture_does_not_depend_on_the_clutter_of_the_one_before(stage: Stage) -> None:
    """A picture has the same bytes before and after one with clutter, and no clutter is left."""
    before = stage.picture(stage.plain)
    between = stage.picture(cluttered(stage.plain))
    after = stage.picture(stage.plain)
    assert before.tobytes() == after.tobytes()
    assert np.abs(between.astype(int) - before.astype(int)).mean() > 3
    for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.images):
        assert not [block.name for block in collection if block.name.startswith(f"{PREFIX}.")]


def test_wear_that_changes_nothing_does_not_show(stage: Stage) -> None:
    """The picture equals that of a floor without wear, byte by byte."""
    assert stage.plain.floor is not None
    worn = stage.plain.floor.model_copy(update={"wear": NEUTRAL})
    same = stage.picture(stage.plain.model_copy(update={"floor": worn}))
    assert same.tobytes() == stage.picture(stage.plain).tobytes()


def test_a_worn_floor_shows_it(stage: Stage) -> None:
    """A floor that is half as bright gives a darker picture."""
    assert stage.plain.floor is not None
    worn = stage.plain.floor.model_copy(update={"wear": NEUTRAL.model_copy(update={"brightness": 0.3})})
    dark = stage.picture(stage.plain.model_copy(update={"floor": worn}))
    assert dark.mean() < 0.8 * stage.picture(stage.plain).mean()
