"""Headers, scenes and pieces of cables for the tests of the worker's stages."""

from farm.scene.cable import Sheath, Skin
from farm.scene.clutter import Stick, StickKind
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, HdriRef, TemplateRef
from farm.spec.job import Job
from farm.spec.parse import parse_spec
from worker.cable.piece import Tubular
from worker.curves import Points
from worker.sample.scene import sample_scene

SHA = "0" * 64


def make_header(**keys: object) -> DatasetHeader:
    """A header over two surfaces and two HDRIs, one of them dark; `keys` are keys of the description."""
    return DatasetHeader(
        farm_version="0",
        spec=parse_spec({"images": 60, "seed": 0, "style": "published", **keys}, source="test"),
        template=TemplateRef(path=None, sha256=SHA),
        surfaces=(
            BuiltinSurfaceRef(name="concrete_smooth", recipe_version=1),
            BuiltinSurfaceRef(name="oak_planks", recipe_version=1),
        ),
        hdris=(
            HdriRef(name="city", path=None, sha256=SHA, dark=False),
            HdriRef(name="night", path=None, sha256=SHA, dark=True),
        ),
    )


def make_scene(category: Category = Category.FAR, index: int = 0, attempt: int = 0, **keys: object) -> Scene:
    """The scene of one attempt at one job."""
    return sample_scene(make_header(**keys), Job(category=category, index=index), attempt)


def make_skin(**keys: object) -> Skin:
    """A plain red sheath; `keys` are fields of the skin."""
    plain = Skin(
        sheath=Sheath.PLAIN,
        colour=(200, 30, 30),
        roughness=0.4,
        stripe=None,
        marking=None,
        dirt=0.0,
        wear=0.0,
        pattern_seed=0,
    )
    return plain.model_copy(update=keys)


def make_stick(kind: StickKind = StickKind.ROD, **keys: object) -> Stick:
    """A grey stick along x through the origin, on its floor; `keys` are fields of the stick."""
    plain = Stick(
        kind=kind,
        diameter_m=0.004,
        length_m=0.1,
        x_m=0.0,
        y_m=0.0,
        start_height_m=0.0,
        rotation_deg=0.0,
        colour=(9, 9, 9),
        pattern_seed=0,
    )
    return plain.model_copy(update=keys)


def tubular(curve: Points, radius_m: float, instance: int = 1) -> Tubular:
    """The single piece of a cable."""
    return Tubular(instance, curve, radius_m, 0.0, 1.0, 1.0, make_skin())
