"""The conversion of drawn cables and sticks to rods, and their resting places."""

import numpy as np
import pytest

from farm.errors import SceneError
from farm.scene.clutter import Peg, StickKind
from farm.scene.knot import Knot, KnotKind
from farm.scene.scene import Scene
from farm.spec.simulation import RodFall
from tests.worker.clutter.things import make_stick
from tests.worker.scenes import make_scene
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import measure
from worker.simulate.rod import fall
from worker.simulate.rod.fall import (
    curvature_at_rest,
    drop_cables,
    most_steps,
    rods_of,
    surroundings_of,
)
from worker.simulate.rod.model import Rod
from worker.simulate.rod.segments import FINEST_RADII, MOST_TURN_RAD, longest_radii, segment_m
from worker.simulate.rod.simulation import RodSimulation

RADIUS_M = 0.0015


def test_segments_of_a_cable_are_so_many_radii_long() -> None:
    """A cable of 1e7 Pa bends under its weight over (1e7 r^2 / 4 rho g)^(1/3) = 49 radii, so the default holds."""
    assert segment_m(RADIUS_M, 1e7, 1500.0, segment_radii=4.0) == pytest.approx(4 * RADIUS_M)


def test_what_bends_more_tightly_has_shorter_segments() -> None:
    """A segment is half of (E r^2 / 4 rho g)^(1/3): here six radii, if E = 4 rho g r 6^3."""
    modulus = 4 * 1500.0 * 9.81 * RADIUS_M * 6**3
    assert segment_m(RADIUS_M, modulus, 1500.0, segment_radii=4.0) == pytest.approx(3 * RADIUS_M)


def test_segments_have_a_least_length() -> None:
    """Segments have a least length for any softness."""
    assert segment_m(RADIUS_M, 1.0, 1500.0, segment_radii=4.0) == pytest.approx(FINEST_RADII * RADIUS_M)


@pytest.mark.parametrize("radii", [8.0, 20.0])
def test_a_tight_coil_has_shorter_segments(radii: float) -> None:
    """Segments turn by half a radian at most; where six radii turn by less, they are that long."""
    scene = make_scene(ranges={"cable": {"count": [1, 1]}})
    drawn = scene.cables[0]
    turning = 1 / (radii * drawn.diameter_m / 2)
    coiled = drawn.model_copy(update={"bends_per_m": (turning,) * 33, "length_m": 0.2, "knot": None})
    (coil,) = rods_of(scene.model_copy(update={"cables": (coiled,), "sticks": ()}), RodFall())
    over_radius = coil.segment_length_m / coil.radius_m
    assert over_radius == pytest.approx(min(longest_radii(RodFall().segment_radii), MOST_TURN_RAD * radii), rel=0.1)


def over_a_stick(kind: StickKind = StickKind.ROD, diameter_m: float = 0.008) -> Scene:
    """Two drawn cables that start above a stick and fall across it."""
    scene = make_scene(ranges={"cable": {"count": [2, 2]}, "placement": {"bend_per_m": [0.0, 0.0]}})
    bearings = (80.0, 110.0)
    cables = tuple(
        cable.model_copy(
            update={
                "x_m": 0.02 * k,
                "y_m": 0.0,
                "rotation_deg": bearing,
                "start_height_m": diameter_m + 0.004 * (k + 1),
            }
        )
        for k, (cable, bearing) in enumerate(zip(scene.cables, bearings, strict=True))
    )
    return scene.model_copy(update={"cables": cables, "sticks": (make_stick(kind, diameter_m=diameter_m),)})


def test_sticks_are_stiff_straight_rods_after_the_cables() -> None:
    """A stick is a rod with its drawn place, length and thickness."""
    *cables, stick = rods_of(over_a_stick(), RodFall())
    assert len(cables) == 2
    assert stick.radius_m == pytest.approx(0.004)
    assert stick.youngs_modulus_pa >= 1e9
    assert stick.nodes_m[0] == pytest.approx(np.array([-0.07, 0.0, 0.005]))
    assert stick.nodes_m[-1] == pytest.approx(np.array([0.07, 0.0, 0.005]))


@pytest.mark.parametrize("diameter_m", [0.003, 0.012])
def test_cables_come_to_lie_on_a_stick(diameter_m: float) -> None:
    """Cables pass over the stick and touch its top within a twentieth of their radius; nothing cuts into anything."""
    scene = over_a_stick(diameter_m=diameter_m)
    shapes = drop_cables(scene, RodFall())
    assert find_fault(measure(shapes)) is None
    (stick,) = shapes.sticks_m
    assert stick[:, 2] == pytest.approx(diameter_m / 2, abs=2e-5)
    # The second cable may lie on the first; the first lies on the stick.
    nodes, radius = shapes.nodes_m[0], shapes.radii_m[0]
    highest = nodes[np.argmin(np.abs(nodes[:, 1] - stick[:, 1].mean()))]
    assert highest[2] == pytest.approx(diameter_m + radius, abs=0.1 * radius)


def test_a_stick_stays_straight_under_cables() -> None:
    """A stick is straight to a hundredth of a millimetre."""
    (stick,) = drop_cables(over_a_stick(), RodFall()).sticks_m
    share = np.linspace(0, 1, len(stick))[:, None]
    assert np.abs(stick - (stick[0] + share * (stick[-1] - stick[0]))).max() < 1e-5


def test_a_scene_without_sticks_falls_as_it_did() -> None:
    """Without sticks the cables are in the order of their start."""
    shapes = drop_cables(over_a_stick().model_copy(update={"sticks": ()}), RodFall())
    assert shapes.sticks_m == ()
    assert len(shapes.stick_radii_m) == 0
    assert shapes.start_order == (0, 1)


def test_the_order_of_the_start_counts_sticks_after_cables() -> None:
    """The stick starts lowest of three and is numbered last."""
    assert drop_cables(over_a_stick(), RodFall()).start_order == (2, 0, 1)


def coiled() -> Scene:
    """A coil whose turns rise as steeply as any."""
    return make_scene(
        ranges={
            "cable": {"count": [1, 1], "diameter_m": 0.004},
            "placement": {"coil_share": 1.0, "coil_radius_m": [0.001, 0.001]},
        }
    )


def test_a_coil_that_rises_is_as_long_as_its_cable() -> None:
    """It is laid at its length, and the fall strains it by a millionth at most."""
    scene, settings = coiled(), RodFall()
    (cable,), (start,) = scene.cables, rods_of(scene, settings)
    laid_m = float(np.linalg.norm(np.diff(start.nodes_m, axis=0), axis=1).sum())
    assert laid_m == pytest.approx(cable.length_m, rel=1e-12)
    shapes = drop_cables(scene, settings)
    assert shapes.lengths_m.tolist() == [cable.length_m]
    assert measure(shapes).length_error < 1e-6


def test_the_natural_curvature_of_a_sloped_circle_is_that_of_its_plan() -> None:
    """With the plan's turn t a segment it is tan(t) / l with the length l along the slope; see `Rod`."""
    turn, count, step = 0.1, 41, 0.004
    angle, plan = turn * np.arange(count), 0.9 * step
    edges = plan * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rise = np.sqrt(step**2 - plan**2) * np.arange(count + 1)
    nodes = np.column_stack([np.concatenate([np.zeros((1, 2)), np.cumsum(edges, axis=0)]), rise])
    assert curvature_at_rest(nodes)[1:-1] == pytest.approx(np.full(count - 1, np.tan(turn) / step))


def with_peg() -> Scene:
    """A cable that starts beside a peg on either side of another one, and falls past it."""
    scene = over_a_stick()
    peg = Peg(x_m=0.0, y_m=0.008, diameter_m=0.01, height_m=0.03, colour=(9, 9, 9), pattern_seed=0)
    cable = scene.cables[0].model_copy(update={"rotation_deg": 0.0, "y_m": 0.0})
    return scene.model_copy(update={"cables": (cable,), "sticks": (), "pegs": (peg,)})


def test_a_peg_is_an_upright_rod_that_nothing_moves() -> None:
    """Its nodes are after those of cables and sticks, from below the floor to its top, and stay where they are."""
    scene = with_peg()
    peg = rods_of(scene, RodFall())[-1]
    assert peg.pinned is not None
    assert peg.pinned.all()
    assert peg.nodes_m[:, :2] == pytest.approx(np.tile([0.0, 0.008], (len(peg.nodes_m), 1)))
    assert (peg.nodes_m[0, 2], peg.nodes_m[-1, 2]) == pytest.approx((-0.005, 0.03))
    shapes = drop_cables(scene, RodFall())
    assert shapes.pegs_m[0].tolist() == peg.nodes_m.tolist()
    assert find_fault(measure(shapes)) is None


def test_the_wind_does_not_blow_a_cable_through_a_peg() -> None:
    """A cable that a strong wind drives against a peg stays on its side, and touches it to 2 % of its radius."""
    scene = with_peg()
    wind = scene.wind.model_copy(update={"speed_m_s": 8.0, "bearing_deg": 270.0, "tilt_deg": 90.0, "gusts": ()})
    shapes = drop_cables(scene.model_copy(update={"wind": wind}), RodFall())
    radius, away = shapes.radii_m[0], np.linalg.norm(shapes.nodes_m[0][:, :2] - [0.0, 0.008], axis=1).min()
    assert away == pytest.approx(0.005 + radius, abs=0.02 * radius)
    assert shapes.nodes_m[0][np.abs(shapes.nodes_m[0][:, 0]) < 0.004, 1].max() < 0.008


def test_a_knotted_rod_is_turned_shifted_and_lifted_to_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    """The rod that is tied along x about the origin comes to lie along the cable's bearing at its place and height."""
    knot = Knot(kind=KnotKind.OVERHAND, along=0.5, loop_radius_m=0.02, mirrored=False, set_share=0.5)
    cable = (
        over_a_stick()
        .cables[0]
        .model_copy(update={"knot": knot, "x_m": 0.1, "y_m": 0.2, "rotation_deg": 90.0, "start_height_m": 0.05})
    )
    along = np.linspace(-0.2, 0.2, 41)
    tied = Rod(
        nodes_m=np.stack([along, np.zeros(41), np.full(41, cable.diameter_m / 2)], axis=1),
        radius_m=cable.diameter_m / 2,
        youngs_modulus_pa=1e7,
        density_kg_m3=1500.0,
    )
    monkeypatch.setattr(fall, "tie", lambda *_: tied)
    (rod,) = rods_of(over_a_stick().model_copy(update={"cables": (cable,), "sticks": ()}), RodFall())
    height = 0.05 + cable.diameter_m / 2
    assert rod.nodes_m[[0, -1]] == pytest.approx(np.array([[0.1, 0.0, height], [0.1, 0.4, height]]))


def test_a_fall_says_whether_it_came_to_rest() -> None:
    """One that is stopped in mid-air has not rested, however slow its cables are."""
    assert drop_cables(over_a_stick(), RodFall()).rested
    assert not drop_cables(over_a_stick(), RodFall(max_time_s=0.001)).rested


def test_a_fall_is_given_up_after_a_number_of_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """The error gives the number of steps and the time that they reached."""
    monkeypatch.setattr(fall, "MOST_STEPS_OVER_PLAN", 0.005)
    with pytest.raises(SceneError, match=r"gave up after 20 time steps, at 0\.02 s of the fall"):
        drop_cables(over_a_stick(), RodFall())


@pytest.mark.parametrize(("settings", "steps"), [({}, 16_000), ({"steps_per_s": 100, "max_time_s": 0.1}, 400)])
def test_a_fall_may_make_some_times_its_planned_steps(settings: dict[str, float], steps: int) -> None:
    """They are those of `max_time_s`, or of a second, as a cable that is stopped early may land in many small steps."""
    scene, rod = over_a_stick(), RodFall.model_validate(settings)
    simulation = RodSimulation(rods_of(scene, rod), surroundings_of(scene), steps_per_s=rod.steps_per_s)
    assert most_steps(simulation, rod) == steps
