"""Piles that have come to rest."""

import numpy as np
import pytest

from farm.spec.simulation import RodFall
from tests.worker.scenes import make_scene
from tests.worker.simulate.physics.rods import line, rod, shapes
from worker.simulate.checks.measure import measure, settled_figures
from worker.simulate.checks.plan_view import find_crossings
from worker.simulate.checks.spans import cut
from worker.simulate.rod.fall import INTERNAL_DAMPING_S, REST_FASTEST_M_S, REST_RMS_M_S, REST_S, drop_cables
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.shapes import CableShapes

Place = tuple[float, float, float]


def missed_gates(shapes: CableShapes) -> dict[str, float]:
    """The figures of gates 1 to 4 that miss their targets."""
    figures = settled_figures(measure(shapes))
    return {gate.name: figure for gate, figure in figures.items() if not gate.on_target(figure)}


@pytest.mark.parametrize("index", range(4))
@pytest.mark.parametrize("cables", [2, 8])
def test_a_drawn_pile_rests_within_its_gates(cables: int, index: int) -> None:
    """Gates 1 to 4 are on target, for cables and wind of the default ranges."""
    scene = make_scene(index=index, ranges={"cable": {"count": [cables, cables]}})
    assert missed_gates(drop_cables(scene, RodFall())) == {}


def across(start: Place, end: Place, *, radius_m: float, modulus_pa: float, density_kg_m3: float) -> Rod:
    """A straight rod in segments of the default length."""
    segments = round(float(np.linalg.norm(np.subtract(end, start))) / (RodFall().segment_radii * radius_m))
    nodes = line(start, end, segments)
    return rod(nodes, radius_m=radius_m, modulus_pa=modulus_pa, density_kg_m3=density_kg_m3)


def test_rods_of_other_radius_stiffness_and_density_rest_on_each_other() -> None:
    """Gates 1 to 4 are on target, with radii, moduli and densities a factor of 3, 100 and 4 apart."""
    rods = [
        across((-0.1, 0, 0.01), (0.1, 0.01, 0.01), radius_m=0.001, modulus_pa=3e7, density_kg_m3=1200),
        across((0, -0.1, 0.02), (0.01, 0.1, 0.02), radius_m=0.002, modulus_pa=1e6, density_kg_m3=5000),
        across((-0.08, -0.08, 0.03), (0.08, 0.08, 0.03), radius_m=0.003, modulus_pa=1e8, density_kg_m3=2500),
        across((-0.08, 0.08, 0.04), (0.08, -0.08, 0.04), radius_m=0.001, modulus_pa=1e6, density_kg_m3=5000),
    ]
    simulation = RodSimulation(rods, Surroundings(damping_s=INTERNAL_DAMPING_S), steps_per_s=RodFall().steps_per_s)
    assert simulation.settle(
        rms_m_s=REST_RMS_M_S, fastest_m_s=REST_FASTEST_M_S, quiet_s=REST_S, max_time_s=RodFall().max_time_s
    )
    assert missed_gates(shapes(simulation, rods)) == {}


PILES = 8


def pile_figures(index: int, steps_per_s: int) -> tuple[float, float, float]:
    """Figures of a pile of four: mean height in radii, root mean square curvature times length, and crossings."""
    scene = make_scene(index=index, ranges={"cable": {"count": [4, 4]}})
    settled = drop_cables(scene, RodFall(steps_per_s=steps_per_s))
    heights = [nodes[:, 2] / radius for nodes, radius in zip(settled.nodes_m, settled.radii_m, strict=True)]
    bends = []
    for nodes, length in zip(settled.nodes_m, settled.lengths_m, strict=True):
        segment = length / (len(nodes) - 1)
        bends.append(np.linalg.norm(np.diff(nodes, n=2, axis=0), axis=1) / segment**2 * length)
    spans = cut(settled.nodes_m)
    crossings = find_crossings(spans, spans.near_in_plan(float(settled.radii_m.max())))
    curvature = float(np.sqrt(np.mean(np.concatenate(bends) ** 2)))
    return float(np.mean(np.concatenate(heights))), curvature, float(len(crossings.one))


def test_piles_are_alike_whatever_the_time_step() -> None:
    """The mean difference over scenes is zero within three standard errors, or 1 % of the mean if these are small.

    Piles are chaotic, so the figures of one scene may differ; over the scenes they may not, one way or the other. A
    bias of the time step itself, first order in h and of the curvature's 1 % at most, hides in no mean.
    """
    coarse = np.array([pile_figures(index, 1000) for index in range(PILES)])
    fine = np.array([pile_figures(index, 2000) for index in range(PILES)])
    difference = fine - coarse
    error = difference.std(axis=0, ddof=1) / np.sqrt(PILES)
    assert (np.abs(difference.mean(axis=0)) <= 3 * error + 0.01 * coarse.mean(axis=0)).all()
