"""The ten gates, on shapes and series with known figures."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from benchmarks.physics.elastica import drooping_shape
from benchmarks.physics.gates import (
    StressFault,
    cantilever_error,
    crossing_error,
    energy_rise,
    largest_movement,
    observed_orders,
    same_bits,
    stress_fault,
)
from benchmarks.physics.ridge import RidgeCrossing
from tests.worker.settled import RADIUS, looped, rod, shapes
from worker.curves import Points
from worker.simulate.checks.measure import Gate, measure, settled_figures
from worker.simulate.shapes import CableShapes


def test_every_gate_has_a_figure() -> None:
    """Gates one to ten have figures, and no target is beyond its bound."""
    assert {gate.value.number for gate in Gate} == set(range(1, 11))
    assert all(gate.value.target <= gate.value.never for gate in Gate)


def test_a_grant_takes_the_place_of_its_own_gates_target_alone() -> None:
    """What is granted in length leaves the other targets as they are."""
    grants = {Gate.LENGTH: 0.005}
    assert not Gate.LENGTH.on_target(0.004)
    assert Gate.LENGTH.on_target(0.004, grants)
    assert not Gate.LENGTH.on_target(0.006, grants)
    assert not Gate.CABLE_PENETRATION.on_target(0.03, grants)


def test_an_order_may_also_be_too_low() -> None:
    """An order of 0.9 to 1.1 is on target."""
    assert [Gate.ORDER.on_target(order) for order in (0.8, 1.0, 1.2)] == [False, True, False]


@pytest.mark.parametrize("gate", Gate)
def test_nan_meets_no_gate(gate: Gate) -> None:
    """NaN is neither on target nor within the bound."""
    assert not gate.on_target(float("nan"))
    assert gate.is_broken_by(float("nan"))


def test_a_cable_on_the_floor_meets_gates_one_to_four() -> None:
    """All figures of a cable on the floor are on target."""
    assert all(gate.on_target(figure) for gate, figure in settled_figures(measure(shapes(rod()))).items())


STICK_RADIUS = 0.004


def beside_a_stick(cable: Points) -> CableShapes:
    """A cable, and a stick of 4 mm radius along y on the floor, which starts below it."""
    stick = rod(along_y=True, z=STICK_RADIUS)
    return replace(shapes(cable, order=(1, 0)), sticks_m=(stick,), stick_radii_m=np.array([STICK_RADIUS]))


def test_a_cable_that_cuts_into_a_stick_breaks_gate_two() -> None:
    """A cable that is half a radius deep in a stick breaks gate 2."""
    figures = measure(beside_a_stick(rod(z=2 * STICK_RADIUS + 0.5 * RADIUS)))
    assert figures.cable_penetration_max == pytest.approx(0.5, abs=0.01)


def test_a_cable_that_rests_on_a_stick_breaks_nothing_there() -> None:
    """A cable that touches a stick's top breaks no gate, and doesn't float."""
    figures = measure(beside_a_stick(rod(z=2 * STICK_RADIUS + RADIUS)))
    assert figures.cable_penetration_max == pytest.approx(0.0, abs=1e-6)
    assert figures.pass_throughs == 0
    assert figures.support_gap == pytest.approx(0.0, abs=1e-6)


def test_a_cable_below_a_stick_went_through_it() -> None:
    """A cable below a stick went through it, as a stick has no end around which a cable could slip."""
    assert measure(beside_a_stick(rod())).pass_throughs == 1


def test_a_loop_is_counted_once() -> None:
    """A loop has one crossing with itself, and nothing passed through."""
    figures = measure(shapes(looped(step=2 * RADIUS)))
    assert (figures.self_crossings, figures.pass_throughs) == (1, 0)


def test_a_gentle_bend_is_no_crossing() -> None:
    """Neighbouring segments share a point and don't cross."""
    assert measure(shapes(rod())).self_crossings == 0


def test_the_order_of_start_decides_what_is_above() -> None:
    """The same shapes have no fault if the cables started the other way round."""
    upside_down = (rod(z=3 * RADIUS), rod(along_y=True))
    assert measure(shapes(*upside_down)).pass_throughs == 1
    assert measure(shapes(*upside_down, order=(1, 0))).pass_throughs == 0


@pytest.mark.parametrize(("end_radii", "figures"), [(9.0, (0, 1)), (11.0, (1, 0))])
@pytest.mark.parametrize("which", [0, 1])
def test_a_flipped_crossing_close_to_an_end_is_a_slip(end_radii: float, figures: tuple[int, int], which: int) -> None:
    """Within ten radii of an end of either cable it is a slip, and farther away a passage."""
    nodes = [rod(z=3 * RADIUS), rod(along_y=True)]
    nodes[which] = nodes[which] + (0.1 - end_radii * RADIUS) * np.array([[1.0, 0, 0], [0, 1.0, 0]])[which]
    found = measure(shapes(*nodes))
    assert (found.pass_throughs, found.end_slips) == figures


def test_the_thicker_cable_says_how_close_an_end_is() -> None:
    """15 mm are ten radii of the thicker cable, of 1.5 mm, which decides."""
    nodes = rod(z=0.004) + np.array([0.085, 0, 0]), rod(along_y=True, z=0.0015)
    slips = [measure(shapes(*nodes, radii=(RADIUS, thick))).end_slips for thick in (0.0014, 0.0016)]
    assert slips == [0, 1]


def test_a_cable_below_the_floor_passed_through_it() -> None:
    """A cable below the floor counts once, and not by its places."""
    sunk = rod()
    sunk[10:30, 2] = -RADIUS
    assert measure(shapes(sunk, rod(y=0.05))).floor_pass_throughs == 1


def test_a_cable_carried_by_another_does_not_float() -> None:
    """The gap below a cable is measured to whatever lies there."""
    assert measure(shapes(rod(), rod(z=3 * RADIUS, along_y=True))).support_gap == pytest.approx(0.0, abs=1e-9)


def cantilever(slenderness: float, edges: int) -> Points:
    """The reference's shape in nodes of equal spacing, with the clamp at the middle of the first edge."""
    arc = (np.arange(edges + 1) - 0.5) / (edges - 0.5)
    out, down = drooping_shape(slenderness, np.maximum(arc, 0)).T
    nodes: Points = np.stack([out, np.zeros_like(out), 1 - down], axis=1)
    edge = 1 / (edges - 0.5)
    nodes[0], nodes[1] = [-edge / 2, 0, 1], [edge / 2, 0, 1]
    return nodes


@pytest.mark.parametrize("slenderness", [1.0, 10.0, 100.0, 1000.0])
def test_the_reference_passes_as_a_cantilever(slenderness: float) -> None:
    """Chords are shorter than arcs by a 24th of the bend squared, which is under 0.1 % with 400 edges."""
    found = cantilever_error(cantilever(slenderness, 400), bending_stiffness_n_m2=1, weight_per_length_n_m=slenderness)
    assert found.error < 1e-3
    assert found.slenderness == pytest.approx(slenderness, rel=2e-3)


@pytest.mark.parametrize(("slenderness", "gate"), [(90.0, Gate.CANTILEVER), (110.0, Gate.SLENDER_CANTILEVER)])
def test_slender_cantilevers_have_a_row_of_their_own(slenderness: float, gate: Gate) -> None:
    """Cantilevers beyond a slenderness of 100 have a gate of their own."""
    found = cantilever_error(cantilever(slenderness, 50), bending_stiffness_n_m2=1, weight_per_length_n_m=slenderness)
    assert found.gate is gate


def test_a_cantilever_that_is_too_stiff_is_off() -> None:
    """The droop under a tenth of the load is off by about nine tenths at small slopes."""
    found = cantilever_error(cantilever(0.1, 100), bending_stiffness_n_m2=1, weight_per_length_n_m=1.0)
    assert found.error == pytest.approx(1 - 0.01250 / 0.12456, rel=1e-2)


def test_a_clamp_that_is_not_level_is_refused() -> None:
    """A clamp that isn't level, as the reference's is, is refused."""
    with pytest.raises(ValueError, match="level"):
        cantilever_error(rod()[:, [2, 1, 0]], bending_stiffness_n_m2=1, weight_per_length_n_m=1)


REFERENCE = RidgeCrossing(bending_stiffness_n_m2=7.9e-6, weight_per_length_n_m=0.046, lift_m=2 * RADIUS)


def lifted_cable(spacing: float, offset: float, error: float = 0.0) -> tuple[Points, NDArray[np.float64]]:
    """The reference's shape in nodes this many lift-off lengths apart, with heights off by `error` radii at random."""
    step = spacing * REFERENCE.lift_off_m
    x = (np.arange(-round(3 / spacing), round(3 / spacing) + 1) + offset) * step
    z = RADIUS * (1 + error * np.random.default_rng(1).uniform(-1, 1, len(x))) + REFERENCE.height_m(x)
    reactions = np.where(np.abs(x) > REFERENCE.lift_off_m, REFERENCE.weight_per_length_n_m * step, 0.0)
    before = int(np.searchsorted(x, 0, side="right")) - 1
    share = -x[before] / step
    reactions[before : before + 2] += REFERENCE.ridge_reaction_n * np.array([1 - share, share])
    return np.stack([x, np.zeros_like(x), z], axis=1), reactions


@settings(max_examples=30, deadline=None)
@given(spacing=st.floats(0.05, 0.3), offset=st.floats(0.0, 0.99))
def test_a_crossing_is_found_from_coarse_nodes(spacing: float, offset: float) -> None:
    """Three to twenty nodes on either side are enough, wherever they stand relative to the ridge."""
    nodes, reactions = lifted_cable(spacing, offset)
    found = crossing_error(nodes, reactions, radius_m=RADIUS, reference=REFERENCE)
    assert found.lift_off_error < 1e-3
    assert found.reaction_error < 1e-9


@settings(max_examples=30, deadline=None)
@given(spacing=st.floats(0.05, 0.3), offset=st.floats(0.0, 0.99))
def test_heights_off_by_a_hundredth_of_the_radius_leave_the_crossing_within_its_gate(
    spacing: float, offset: float
) -> None:
    """The penetration that gate 2 allows in the floor doesn't break gate 6."""
    nodes, reactions = lifted_cable(spacing, offset, error=0.01)
    assert Gate.LIFT_OFF.on_target(
        crossing_error(nodes, reactions, radius_m=RADIUS, reference=REFERENCE).lift_off_error
    )


def test_another_shape_than_the_crossings_does_not_fit() -> None:
    """A tent has a large misfit."""
    nodes, reactions = lifted_cable(0.1, 0.0)
    nodes[:, 2] = RADIUS + REFERENCE.lift_m * np.maximum(1 - np.abs(nodes[:, 0]) / REFERENCE.lift_off_m, 0)
    assert crossing_error(nodes, reactions, radius_m=RADIUS, reference=REFERENCE).misfit > 0.02


def test_a_cable_on_the_floor_crosses_nothing() -> None:
    """A cable on the floor has nothing to fit, and is refused."""
    with pytest.raises(ValueError, match="in the air"):
        crossing_error(rod(), np.zeros(41), radius_m=RADIUS, reference=REFERENCE)


def test_only_rises_of_the_energy_count() -> None:
    """The figure is the greatest step up, as a share of the start's energy."""
    assert energy_rise(np.array([2.0, 1.0, 1.5, 1.2, 1.3])) == pytest.approx(0.25)
    assert energy_rise(np.array([2.0, 1.0, 0.5])) == 0


def test_an_energy_that_is_no_number_breaks_the_gate() -> None:
    """An energy of NaN doesn't pass for one that never rises."""
    assert Gate.ENERGY_RISE.is_broken_by(energy_rise(np.array([2.0, np.nan, 1.0])))


@given(order=st.floats(0.5, 3.0), factor=st.floats(0.1, 10.0))
def test_the_order_of_errors_that_follow_a_power_is_that_power(order: float, factor: float) -> None:
    """Both halvings give the power."""
    found = observed_orders((factor, factor * 0.5**order, factor * 0.25**order))
    assert found == pytest.approx((order, order))


def test_movement_is_counted_in_radii_of_its_cable() -> None:
    """A thin cable that moved less counts for more."""
    before = shapes(rod(), rod(y=0.05), radii=(0.001, 0.004))
    after = replace(before, nodes_m=(before.nodes_m[0] + [0.0005, 0, 0], before.nodes_m[1] + [0.001, 0, 0]))
    assert largest_movement(before, after) == pytest.approx(0.5)


def test_the_same_run_twice_has_the_same_bits() -> None:
    """Every array and number of the two runs is the same."""
    assert same_bits(shapes(rod(), looped()), shapes(rod(), looped()))


RUN = shapes(rod(), looped())


@pytest.mark.parametrize(
    "other",
    [
        replace(RUN, nodes_m=(RUN.nodes_m[0], np.nextafter(RUN.nodes_m[1], 1.0))),
        replace(RUN, speeds_m_s=(RUN.speeds_m_s[0], -RUN.speeds_m_s[1])),
        replace(RUN, lengths_m=np.nextafter(RUN.lengths_m, 1.0)),
        replace(RUN, radii_m=np.nextafter(RUN.radii_m, 1.0)),
        replace(RUN, start_order=(1, 0)),
        replace(RUN, fall_s=float(np.nextafter(RUN.fall_s, 1.0))),
        replace(RUN, steps=RUN.steps + 1),
    ],
)
def test_one_bit_is_a_difference(other: CableShapes) -> None:
    """A difference of one bit in any field counts, and the sign of a zero, too."""
    assert not same_bits(RUN, other)


def test_a_stress_run_is_judged_by_what_was_seen_on_the_way() -> None:
    """If passages were counted on the way, the order of the start doesn't matter."""
    turned = shapes(rod(z=3 * RADIUS), rod(along_y=True))
    assert stress_fault(turned, reach_m=1.0, passes=0) is None
    assert stress_fault(shapes(rod()), reach_m=1.0, passes=1) is StressFault.PASSED_THROUGH


@pytest.mark.parametrize(
    ("run", "fault"),
    [
        (shapes(rod()), None),
        (shapes(rod() * np.nan), StressFault.NOT_FINITE),
        (shapes(rod(), speed=np.inf), StressFault.NOT_FINITE),
        (shapes(rod() + np.array([5.0, 0, 0])), StressFault.ESCAPED),
        (shapes(rod(z=-0.01)), StressFault.PASSED_THROUGH),
        (shapes(rod(z=3 * RADIUS), rod(along_y=True)), StressFault.PASSED_THROUGH),
        (replace(shapes(rod()), lengths_m=np.array([0.1996])), StressFault.STRETCHED),
        (shapes(rod(), rod(y=1.7 * RADIUS)), StressFault.PENETRATED),
        (shapes(rod(z=0.7 * RADIUS)), StressFault.PENETRATED),
        (shapes(rod(), speed=0.01), StressFault.NOT_AT_REST),
    ],
)
def test_a_stress_run_fails_for_its_reason(run: CableShapes, fault: StressFault | None) -> None:
    """Each fault alone gives its reason, and no fault none."""
    assert stress_fault(run, reach_m=1.0) is fault
