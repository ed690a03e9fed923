"""What drawn scenes hold."""

from collections.abc import Callable

import pytest

from benchmarks.stress.holds import Holding, held_by
from farm.scene.cable import Cable, CableMaterial
from farm.scene.clutter import Peg
from farm.scene.knot import Knot, KnotKind
from farm.scene.scene import Scene
from tests.worker.scenes import make_scene, make_stick
from worker.sample.cable_curve import FINE_KNOTS

GENTLE = (2.0, -1.0, 0.5, 1.0, -2.0, 0.0, 1.0)
KNOT = Knot(kind=KnotKind.OVERHAND, along=0.5, loop_radius_m=0.02, mirrored=False, set_share=0.5)
PEG = Peg(x_m=0.0, y_m=0.008, diameter_m=0.01, height_m=0.03, colour=(9, 9, 9), pattern_seed=0)
EVEN = tuple(40.0 + k % 3 for k in range(FINE_KNOTS))
BUMP = tuple(60.0 if 12 < k < 20 else 1.0 for k in range(FINE_KNOTS))


def cable(start_m: float = 0.01, **keys: object) -> Cable:
    """A gently bent cable, 2 mm thick."""
    plain = CableMaterial(
        colour=(9, 9, 9),
        dirt_colour=(0, 0, 0),
        dirt_position=0.7,
        dirt_mapping=(0, 0, 0),
        dirt_offset=0,
        reflection_position=0.6,
    )
    given = {
        "diameter_m": 0.002,
        "length_m": 0.3,
        "x_m": 0.0,
        "y_m": 0.0,
        "start_height_m": start_m,
        "rotation_deg": 0.0,
        "bends_per_m": GENTLE,
        "youngs_modulus_pa": 1e7,
        "density_kg_m3": 1500.0,
        "material": plain,
    }
    return Cable.model_validate(given | keys)


def scene(*cables: Cable, **keys: object) -> Scene:
    """A scene with these cables."""
    return make_scene().model_copy(update={"cables": cables, "sticks": (), **keys})


@pytest.mark.parametrize(
    ("made", "held"),
    [
        (lambda: scene(cable(), cable(0.02)), (Holding.PLAIN,)),
        (lambda: scene(cable(bends_per_m=EVEN)), (Holding.COIL,)),
        (lambda: scene(cable(bends_per_m=BUMP)), (Holding.LOOP,)),
        (lambda: scene(cable(), sticks=(make_stick(diameter_m=0.003),)), (Holding.STICK,)),
        (lambda: scene(cable(knot=KNOT)), (Holding.KNOT,)),
        (lambda: scene(cable(heights_m=(0.0, 0.004, 0.0))), (Holding.WOVEN,)),
        (lambda: scene(cable(), pegs=(PEG,)), (Holding.PEG,)),
        (lambda: scene(cable(0.01, diameter_m=0.0041), cable(0.02)), (Holding.THIN_ON_THICK,)),
        (lambda: scene(cable(0.02, diameter_m=0.0041), cable(0.01)), (Holding.THICK_ON_THIN,)),
        (
            lambda: scene(cable(0.01, density_kg_m3=4000.0), cable(0.02, youngs_modulus_pa=2e7)),
            (Holding.LIGHT_STIFF,),
        ),
    ],
)
def test_a_scene_is_called_by_what_it_holds(made: Callable[[], Scene], held: tuple[Holding, ...]) -> None:
    """Each trait alone is found, and a scene without any is plain."""
    assert held_by(made()) == held


def test_a_scene_may_hold_several_things() -> None:
    """A coil above a thick cable counts twice, in the order of the kinds."""
    both = scene(cable(0.01, diameter_m=0.0041), cable(0.02, bends_per_m=EVEN))
    assert held_by(both) == (Holding.COIL, Holding.THIN_ON_THICK)
