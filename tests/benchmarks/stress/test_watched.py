"""Falls that are watched."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.stress.watched import WatchedSimulation, watching
from tests.worker.settled import RADIUS, rod
from worker.simulate.rod import fall
from worker.simulate.rod.fall import REST_FASTEST_M_S, REST_RMS_M_S, REST_S
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation, TooManyStepsError

RODS = [Rod(rod(z=2 * RADIUS), RADIUS, 1e7, 1500.0), Rod(rod(along_y=True, z=6 * RADIUS), RADIUS, 1e7, 1500.0)]
AIR = Surroundings(damping_s=0.01, resistance=0.01)


def settle(simulation: RodSimulation, max_steps: int = 10_000) -> bool:
    """Whether the rods rest within a second, by the rule of drawn scenes."""
    return simulation.settle(
        rms_m_s=REST_RMS_M_S, fastest_m_s=REST_FASTEST_M_S, quiet_s=REST_S, max_time_s=1.0, max_steps=max_steps
    )


def test_looking_changes_no_bit_of_a_fall() -> None:
    """A watched fall of two crossed rods ends after as many steps, with the same bits, as one that is not watched."""
    plain, watched = RodSimulation(RODS, AIR, steps_per_s=1000), WatchedSimulation(RODS, AIR, steps_per_s=1000)
    assert settle(plain) == settle(watched)
    assert plain.steps == watched.steps
    assert all(plain.nodes_m(k).tobytes() == watched.nodes_m(k).tobytes() for k in range(2))
    assert watched.watch.passes == watched.watch.undone == 0


def test_steps_end_as_they_would_unwatched() -> None:
    """The number of steps that a fall may make is kept to, and its end is told in the same way."""
    simulation = WatchedSimulation(RODS, AIR, steps_per_s=1000)
    with pytest.raises(TooManyStepsError):
        settle(simulation, max_steps=7)
    assert simulation.steps == 7


def test_a_rod_that_is_carried_through_another_is_seen() -> None:
    """Without contact between the looks, a rod that is moved below the other has passed through it; where is told."""
    simulation = WatchedSimulation(RODS, AIR, steps_per_s=1000)
    simulation._motion.x[2, : len(RODS[0].nodes_m)] += 10 * RADIUS
    simulation._look()
    assert simulation.watch.passes == 1
    (told,) = simulation.describe_passages()
    assert told.startswith("rods 0 and 1 at 100.0 and 100.0 radii along, 0.0000 s")


def test_a_rod_that_is_flung_away_ends_the_fall() -> None:
    """A rod at 3 m/s is beyond 0.2 m after a few looks."""
    simulation = WatchedSimulation(RODS[:1], AIR, steps_per_s=1000, reach_m=0.2)
    simulation.set_velocities(0, np.tile([3.0, 0.0, 0.0], (41, 1)))
    assert not settle(simulation)
    assert simulation.escaped
    assert simulation.time_s < 0.1


def test_passages_before_the_parting_do_not_count() -> None:
    """Rods that start within each other may part either way."""
    simulation = WatchedSimulation(RODS, AIR, steps_per_s=1000, parting_s=0.5)
    simulation._motion.x[2, : len(RODS[0].nodes_m)] += 10 * RADIUS
    simulation._look()
    simulation._follow(0.0)
    assert simulation.watch.passes == 0


def test_rods_that_fall_together_are_seldom_looked_at() -> None:
    """High in the air rods of one speed make more steps at once than near the floor, where each may be stopped."""
    high = [replace(each, nodes_m=each.nodes_m + np.array([0.0, 0.0, 1.0])) for each in RODS]
    strides = []
    for rods in (high, RODS):
        simulation = WatchedSimulation(rods, AIR, steps_per_s=1000)
        for k in range(2):
            simulation.set_velocities(k, np.tile([0.0, 0.0, -0.25], (41, 1)))
        simulation._speed_m_s = simulation._fastest_m_s()
        strides.append(simulation._stride())
    # 9.81 / 2 t^2 is half a radius after 10 ms; at 0.25 m/s it takes 2 ms.
    assert strides == [7, 1]


def test_the_workers_own_fall_is_watched_within_the_context_alone() -> None:
    """`drop_cables` finds the watched simulation in the place of its own, and its own afterwards."""
    with watching(reach_m=1.0) as made:
        vars(fall)["RodSimulation"](RODS, AIR, steps_per_s=1000)
    assert [type(each) for each in made] == [WatchedSimulation]
    assert vars(fall)["RodSimulation"] is RodSimulation
