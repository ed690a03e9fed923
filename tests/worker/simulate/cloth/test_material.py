"""Conversion of Young's modulus to the settings of a strip, and back."""

import pytest

from farm.scene.scene import Scene
from farm.spec.simulation import ClothFall
from tests.worker.scenes import make_scene
from worker.simulate.cloth.material import achieved_moduli_pa, achieved_stiffness, material_for, most_bending

FALL = ClothFall()


def scene_of(modulus_pa: float) -> Scene:
    """Three cables of one modulus and of different densities."""
    return make_scene(ranges={"cable": {"count": [3, 3], "youngs_modulus_pa": [modulus_pa, modulus_pa]}})


@pytest.mark.parametrize("modulus_pa", [1e6, 3e6, 1e7, 3e7])
def test_the_drawn_range_of_moduli_is_reached(modulus_pa: float) -> None:
    """At the default quality every modulus in the default range is achieved, at any density."""
    assert achieved_moduli_pa(scene_of(modulus_pa), FALL) == pytest.approx([modulus_pa] * 3)


def test_a_modulus_that_would_be_unstable_is_lowered_and_told() -> None:
    """A cable as stiff as hard plastic gets the highest safe setting, and the achieved modulus is reported."""
    assert all(modulus < 1e8 for modulus in achieved_moduli_pa(scene_of(3e9), FALL))


def test_quality_raises_the_reachable_stiffness_by_its_square() -> None:
    """Twice the solver steps allow four times the bending setting."""
    assert most_bending(0.4, ClothFall(quality=20)) == pytest.approx(4 * most_bending(0.4, FALL))


def test_the_material_does_not_depend_on_the_vertex_mass() -> None:
    """Heavier vertices get a bending setting in proportion, so that stiffness over weight stays."""
    for mass in (0.3, 0.5):
        material = material_for([20.0, 80.0], mass, FALL)
        achieved = [achieved_stiffness(bending, material.vertex_mass) for bending in material.bending]
        assert achieved == pytest.approx([20.0, 80.0])
