"""Bundles, which fall as one rod: its stiffness and weight against those of the strands, one by one."""

from functools import cache

import numpy as np
import pytest

from benchmarks.physics.gates import cantilever_error
from farm.scene.cable import Bundle
from farm.scene.camera import Camera
from farm.spec.styles import RANGES_OF, Style
from tests.worker.simulate.physics.rods import DENSITY_KG_M3, GRAVITY_M_S2, MODULUS_PA, line, rod
from worker.cable.strands import places
from worker.sample.cable_kind import TIED, CableKind, sample_kinds
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

STRANDS = pytest.mark.parametrize("strands", range(2, 8))


@cache
def bundle(strands: int) -> tuple[CableKind, float]:
    """A bundle of the style `wide` with this many strands, and the radius of a strand."""
    cable = RANGES_OF[Style.WIDE].cable
    ranges = cable.model_copy(
        update={
            "skin": cable.skin.model_copy(update={"share": 1.0}),
            "bundle": cable.bundle.model_copy(update={"share": 1.0, "strands": (strands, strands)}),
        }
    )
    [kind] = sample_kinds(ranges, 1, Camera(height_m=0.2, f_number=8.0), np.random.default_rng(0))
    assert isinstance(kind.look, Bundle)
    return kind, kind.look.strand_diameter_m / 2


def as_rod(strands: int, length_m: float, segments: int) -> Rod:
    """A bundle of a length, clamped at its first two nodes, as the solver takes it."""
    kind, _ = bundle(strands)
    half_m = length_m / (segments - 0.5) / 2
    return rod(
        line((-half_m, 0, 1), (length_m, 0, 1), segments),
        radius_m=kind.diameter_m / 2,
        modulus_pa=MODULUS_PA * kind.stiffness_ratio,
        density_kg_m3=DENSITY_KG_M3 * kind.density_ratio,
        pinned=(0, 1),
    )


def of_strands(strands: int) -> tuple[float, float]:
    """Bending stiffness and weight per length of loose strands, which add up."""
    _, radius_m = bundle(strands)
    stiffness = sum(MODULUS_PA * np.pi * radius_m**4 / 4 for _ in range(strands))
    weight = sum(DENSITY_KG_M3 * np.pi * radius_m**2 * GRAVITY_M_S2 for _ in range(strands))
    return float(stiffness), float(weight)


def composite_n_m2(strands: int) -> float:
    """Bending stiffness of strands glued into one twisted section: sum of E (pi r^4 / 4 + pi r^2 y^2) over the strands.

    The section turns along the bundle. A constant moment bends it on the mean by M / 2 (1 / EI_1 + 1 / EI_2), with the
    section's two principal stiffnesses; from three strands on, these are equal.
    """
    _, radius_m = bundle(strands)
    away = places(strands) * radius_m
    principal = MODULUS_PA * np.pi * radius_m**2 * (strands * radius_m**2 / 4 + np.sum(away**2, axis=0))
    return float(2 / np.sum(1 / principal))


@STRANDS
def test_a_bundle_weighs_what_its_strands_weigh(strands: int) -> None:
    """The mass per length is N rho pi r^2, as if strands did not wind: at the shortest lay they are 1 % longer."""
    one = as_rod(strands, 0.2, 20)
    assert one.mass_per_length_kg_m * GRAVITY_M_S2 == pytest.approx(of_strands(strands)[1], rel=1e-12)


@STRANDS
def test_a_bundle_is_stiffer_than_loose_strands_by_one_factor(strands: int) -> None:
    """EI is `TIED` N E pi r^4 / 4, whatever the number of strands, and so at least the sum of the strands' own."""
    loose, _ = of_strands(strands)
    found = as_rod(strands, 0.2, 20).bending_stiffness_n_m2
    assert found == pytest.approx(TIED * loose, rel=1e-12)
    assert found >= loose


@pytest.mark.parametrize("strands", range(3, 8))
def test_a_bundle_is_softer_than_glued_strands(strands: int) -> None:
    """EI is at most that of the composite section, N E pi r^4 / 4 (1 + 2 a^2 / r^2) for a ring at a from the middle."""
    assert as_rod(strands, 0.2, 20).bending_stiffness_n_m2 <= composite_n_m2(strands)


@pytest.mark.parametrize("strands", [2, 7])
def test_a_bundle_that_is_clamped_droops_as_its_strands_ask(strands: int) -> None:
    """H/W is the master curve's at G = w L^3 / EI = 10, with w the strands' weight and EI `TIED` times their sum."""
    slenderness = 10.0
    loose, weight = of_strands(strands)
    length_m = float((slenderness * TIED * loose / weight) ** (1 / 3))
    one = as_rod(strands, length_m, 40)
    surroundings = Surroundings(floor=False, gravity_m_s2=(0, 0, -GRAVITY_M_S2), damping_s=0.05)
    simulation = RodSimulation([one], surroundings, steps_per_s=100)
    assert simulation.settle(rms_m_s=1e-6, fastest_m_s=1e-5, quiet_s=0.05, max_time_s=60)
    error = cantilever_error(simulation.nodes_m(0), bending_stiffness_n_m2=TIED * loose, weight_per_length_n_m=weight)
    assert error.slenderness == pytest.approx(slenderness, rel=1e-6)
    assert error.gate.on_target(error.error)
