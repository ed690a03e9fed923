"""The list of pairs that may touch, against an exhaustive search."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.worker.simulate.physics.rods import line, rod
from worker.simulate.rod.arrays import Bodies, Motion, flatten
from worker.simulate.rod.broad_phase import (
    HORIZON_STEPS,
    NEIGHBOUR_RADII,
    SWEEP_RADII,
    Candidates,
    find_candidates,
    middle_of,
    no_candidates,
    still_hold,
)
from worker.simulate.rod.curves import find_bends, find_bulge
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import APPROACH_SHARE, NEARBY_SHARE, SPARE_SHARE, closest, find_reach
from worker.simulate.shapes import bent_rod

STEP_S = 1e-3
AT_REST = np.zeros(3)
SEED = st.integers(0, 2**32 - 1)


def heap(seed: int, rods: int = 4, speed_m_s: float = 0.5) -> tuple[Bodies, Motion]:
    """Bent rods of different radii close over each other, each with a speed of its own."""
    draw = np.random.default_rng(seed)
    drawn = []
    for k in range(rods):
        level = bent_rod(0.1, tuple(draw.normal(0, 30, 5)), 21 + 3 * k) + draw.uniform(-0.02, 0.02, 2)
        nodes = np.column_stack([level, np.full(len(level), 0.003 * k)])
        drawn.append(rod(nodes, radius_m=draw.uniform(0.0005, 0.0015)))
    bodies, motion = flatten(drawn)
    motion.v[:] = draw.normal(0, speed_m_s, (3, rods))[:, bodies.owner] + draw.normal(0, 0.05, motion.v.shape)
    return bodies, motion


def margin_m(bodies: Bodies, v: Array, frame: Array, step_s: float) -> float:
    """The margin, as in `worker.simulate.rod.march`."""
    fastest = np.linalg.norm(v - frame[:, None], axis=0).max()
    return float(2 * step_s * fastest + 0.1 * bodies.radius.min())


def bulge_m(bodies: Bodies, x: Array) -> Array:
    """The bulge at each node."""
    bends, bulge = np.empty(x.shape), np.empty(len(bodies.owner))
    find_bends(bodies, x, bends)
    find_bulge(bends, bulge)
    return bulge


def reach_m(bodies: Bodies, v: Array, bulge: Array, frame: Array = AT_REST, step_s: float = STEP_S) -> Array:
    """The reach of each node."""
    reach = np.empty(len(bodies.owner))
    find_reach(bodies, v, frame, step_s, margin_m(bodies, v, frame, step_s), bulge, reach)
    return reach


def listed(bodies: Bodies, motion: Motion, frame: Array = AT_REST, before: Candidates | None = None) -> Candidates:
    """A new list of pairs."""
    before = no_candidates(len(bodies.owner)) if before is None else before
    reach = reach_m(bodies, motion.v, bulge_m(bodies, motion.x), frame)
    return find_candidates(bodies, motion, frame, STEP_S, reach, before)


def near_pairs(bodies: Bodies, x: Array, v: Array, bulge: Array, step_s: float = STEP_S) -> set[tuple[int, int]]:
    """All pairs of segments that are near in a step, by an exhaustive search."""
    starts = np.flatnonzero(bodies.owner[1:] == bodies.owner[:-1]).tolist()
    margin = margin_m(bodies, v, AT_REST, step_s)
    pairs = set()
    for i in starts:
        for j in starts:
            one, other = bodies.owner[i], bodies.owner[j]
            between = (j - i - 1) * bodies.length[one] if one == other else np.inf
            if j > i and j - i >= 2 and between >= NEIGHBOUR_RADII * bodies.radius[one]:
                s, t = closest(x, i, j)
                apart, way = (
                    np.linalg.norm(a[:, i] + s * (a[:, i + 1] - a[:, i]) - a[:, j] - t * (a[:, j + 1] - a[:, j]))
                    for a in (x, step_s * v)
                )
                radii = bodies.radius[[one, other]]
                near = min(margin, APPROACH_SHARE * way + NEARBY_SHARE * margin)
                bulges = bulge[i : i + 2].max() + bulge[j : j + 2].max()
                if apart <= radii.sum() + SPARE_SHARE * radii.min() + near + bulges:
                    pairs.add((i, j))
    return pairs


def pairs_of(candidates: Candidates) -> list[tuple[int, int]]:
    """The pairs in the order of the list."""
    return list(zip(candidates.one.tolist(), candidates.other.tolist(), strict=True))


@settings(max_examples=15, deadline=None)
@given(seed=SEED)
def test_all_pairs_that_are_near_are_listed_once_in_ascending_order(seed: int) -> None:
    """No pair is missed or named twice, and none has neighbours or the gap between two rods."""
    bodies, motion = heap(seed)
    pairs = pairs_of(listed(bodies, motion))
    assert near_pairs(bodies, motion.x, motion.v, bulge_m(bodies, motion.x)) <= set(pairs)
    assert pairs == sorted(set(pairs))
    for i, j in pairs:
        assert i < j
        assert bodies.owner[i] == bodies.owner[i + 1]
        assert bodies.owner[j] == bodies.owner[j + 1]
        rod_of = bodies.owner[i]
        assert (
            rod_of != bodies.owner[j] or (j - i - 1) * bodies.length[rod_of] >= NEIGHBOUR_RADII * bodies.radius[rod_of]
        )


@settings(max_examples=15, deadline=None)
@given(seed=SEED, shake=st.floats(0, 0.3))
def test_a_list_that_still_holds_misses_none(seed: int, shake: float) -> None:
    """Nodes stop sooner or later on their ways, leave these a little, and change their speeds.

    That tears the rods apart, so that they have no curve; its bulge is taken to be that of the start.
    """
    bodies, motion = heap(seed)
    candidates, bulge = listed(bodies, motion), bulge_m(bodies, motion.x)
    draw = np.random.default_rng(seed)
    farthest = SWEEP_RADII * bodies.radius.max()
    ways = np.clip(HORIZON_STEPS * STEP_S * motion.v, -farthest, farthest)
    for _ in range(4):
        x = motion.x + ways * draw.uniform(0, 1, ways.shape[1])
        x += shake * bodies.radius.min() * draw.uniform(-1, 1, x.shape)
        v = motion.v * draw.uniform(0, 1, ways.shape[1])
        step_s = STEP_S * draw.choice([0.5, 1.0])
        assert still_hold(candidates, x, reach_m(bodies, v, bulge, AT_REST, step_s), together=False)
        assert near_pairs(bodies, x, v, bulge, step_s) <= set(pairs_of(candidates))


def test_a_list_lasts_while_some_rods_land_and_others_rest() -> None:
    """While one rod falls at 1 m/s and another rests, the list holds for some steps, whenever the first is stopped."""
    bodies, motion = flatten([rod(line((0, 0, z), (0.1, 0, z), 20)) for z in (0.001, 0.006)])
    motion.v[2, 21:] = -1.0
    candidates = listed(bodies, motion)
    for steps in range(5):
        x = motion.x + motion.v * min(steps, 3) * STEP_S
        v = motion.v if steps < 3 else np.zeros_like(motion.v)
        assert still_hold(candidates, x, reach_m(bodies, v, bulge_m(bodies, x)), together=False)


@pytest.mark.parametrize("node", [0, 7, 30])
def test_a_node_that_leaves_its_way_ends_the_list(node: int) -> None:
    """A node that moves aside by a radius ends the list."""
    bodies, motion = heap(0, speed_m_s=0.1)
    candidates = listed(bodies, motion)
    reach = reach_m(bodies, motion.v, bulge_m(bodies, motion.x))
    assert still_hold(candidates, motion.x, reach, together=False)
    motion.x[1, node] += bodies.radius.max()
    assert not still_hold(candidates, motion.x, reach, together=False)


def test_more_speed_or_a_longer_step_ends_the_list() -> None:
    """Faster nodes or longer steps reach farther than the list was made for, and end it; slower, shorter ones don't."""
    bodies, motion = heap(0)
    candidates = listed(bodies, motion)
    for faster, longer, holds in [(1, 1, True), (0.5, 1, True), (1, 0.5, True), (5, 1, False), (1, 5, False)]:
        reach = reach_m(bodies, faster * motion.v, bulge_m(bodies, motion.x), AT_REST, longer * STEP_S)
        assert still_hold(candidates, motion.x, reach, together=False) is holds


def test_a_common_motion_does_not_matter_before_rods_land() -> None:
    """After a common motion of metres at 20 m/s the rods have the same list as at rest."""
    bodies, motion = heap(0, speed_m_s=0.0)
    still = pairs_of(listed(bodies, motion, middle_of(motion.v)))
    motion.v[:] += np.array([[3.0], [0.0], [-20.0]])
    frame = middle_of(motion.v)
    candidates = listed(bodies, motion, frame)
    assert pairs_of(candidates) == still
    far = motion.x + np.array([[0.9], [0.0], [-6.0]])
    reach = reach_m(bodies, motion.v, bulge_m(bodies, far), frame)
    assert still_hold(candidates, far, reach, together=True)
    assert not still_hold(candidates, far, reach, together=False)


def test_an_empty_list_does_not_hold() -> None:
    """An empty list doesn't hold, so the first step makes one."""
    bodies, motion = heap(0)
    reach = reach_m(bodies, motion.v, bulge_m(bodies, motion.x))
    assert not still_hold(no_candidates(len(bodies.owner)), motion.x, reach, together=False)


def test_a_new_list_remembers_what_the_old_one_did() -> None:
    """Normals and impulses are kept with their pairs; a new pair has none."""
    bodies, motion = heap(1)
    before = listed(bodies, motion)
    before.normal[:], before.impulse[:] = np.random.default_rng(0).normal(size=(2, len(before.one), 3))
    known = {pair: (before.normal[k], before.impulse[k]) for k, pair in enumerate(pairs_of(before))}
    motion.x[:, bodies.owner == 1] += np.array([[0.004], [0.004], [0.0]])
    after = listed(bodies, motion, before=before)
    pairs = pairs_of(after)
    assert 0 < len(set(pairs) & set(known)) < len(pairs)
    for k, pair in enumerate(pairs):
        normal, impulse = known.get(pair, (AT_REST, AT_REST))
        assert after.normal[k].tolist() == normal.tolist()
        assert after.impulse[k].tolist() == impulse.tolist()


@pytest.mark.parametrize("place", [1e9, -1e300, np.inf, np.nan])
@pytest.mark.parametrize("speed_m_s", [0.0, 1e6, 1e300, np.nan])
def test_a_node_that_flies_off_neither_hides_pairs_nor_makes_impossible_ones(place: float, speed_m_s: float) -> None:
    """Pairs without a node that flies off are listed as ever, and all listed segments exist."""
    bodies, motion = heap(2)
    bulge = bulge_m(bodies, motion.x)
    expected = {pair for pair in near_pairs(bodies, motion.x, motion.v, bulge) if not {4, 5} & set(pair)}
    motion.x[:, 5], motion.v[:, 5] = place, speed_m_s
    reach = reach_m(bodies, np.where(np.arange(len(bodies.owner)) == 5, 0.0, motion.v), bulge)
    reach[5] = np.abs(speed_m_s)
    candidates = find_candidates(bodies, motion, AT_REST, STEP_S, reach, no_candidates(len(bodies.owner)))
    assert expected <= set(pairs_of(candidates))
    assert (bodies.owner[candidates.one] == bodies.owner[candidates.one + 1]).all()
    assert (bodies.owner[candidates.other] == bodies.owner[candidates.other + 1]).all()


def test_rods_kilometres_apart_have_a_list_of_their_own() -> None:
    """The list has only the near pairs of each rod."""
    one = rod(line((0, 0, 0), (0.1, 0, 0), 20))
    other = rod(line((0, 0.001, 0.0015), (0.1, 0.001, 0.0015), 20))
    far = np.array([1e5, 2e5, 0.0])
    bodies, motion = flatten([one, other, rod(one.nodes_m + far), rod(other.nodes_m + far)])
    owners = {(bodies.owner[i], bodies.owner[j]) for i, j in pairs_of(listed(bodies, motion))}
    assert owners == {(0, 1), (2, 3)}


def test_all_in_one_place_is_listed() -> None:
    """More pairs than the first array holds are listed: every segment of three rods with every one of the others."""
    bodies, motion = flatten([rod(line((0, 0, 0), (0.1, 0, 0), 60)) for _ in range(3)])
    motion.x[:] *= 1e-3
    assert len([1 for i, j in pairs_of(listed(bodies, motion)) if bodies.owner[i] != bodies.owner[j]]) == 3 * 60 * 60
