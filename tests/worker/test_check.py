"""Checks of a settled scene, on shapes whose figures are known."""

from dataclasses import replace

import numpy as np
import pytest

from worker.check import find_fault, measure
from worker.shapes import CableShapes, Points

RADIUS = 0.001


def rod(*, y: float = 0.0, z: float = RADIUS, along_y: bool = False) -> Points:
    """A straight cable of 0.2 m in 41 nodes."""
    s = np.linspace(-0.1, 0.1, 41)
    zero = np.zeros_like(s)
    return np.stack([zero if along_y else s, s if along_y else zero + y, zero + z], axis=1)


def shapes(*nodes: Points, order: tuple[int, ...] | None = None, speed: float = 0.0) -> CableShapes:
    """Cables of one radius, started in the given order."""
    return CableShapes(
        nodes_m=nodes,
        radii_m=np.full(len(nodes), RADIUS),
        lengths_m=np.full(len(nodes), 0.2),
        speeds_m_s=tuple(np.full(len(each), speed) for each in nodes),
        start_order=order or tuple(range(len(nodes))),
        fall_s=0.5,
        steps=50,
    )


def test_a_cable_on_the_floor_is_sound() -> None:
    """No figure is off."""
    figures = measure(shapes(rod()))
    assert find_fault(figures) is None
    assert figures.floor_penetration == pytest.approx(0.0, abs=1e-12)
    assert figures.support_gap == pytest.approx(0.0, abs=1e-12)


def test_cables_that_cross_one_diameter_apart_touch() -> None:
    """Neither penetration nor gap."""
    figures = measure(shapes(rod(), rod(z=3 * RADIUS, along_y=True)))
    assert figures.cable_penetration_max == pytest.approx(0.0, abs=1e-9)
    assert find_fault(figures) is None


def test_the_depth_of_a_cut_is_measured_over_the_radius() -> None:
    """Centrelines 1.5 radii apart cut by half a radius."""
    figures = measure(shapes(rod(), rod(z=2.5 * RADIUS, along_y=True)))
    assert figures.cable_penetration_max == pytest.approx(0.5, abs=1e-6)
    assert "cable penetration" in str(find_fault(figures))


def test_cables_side_by_side_that_overlap_are_refused() -> None:
    """Parallel cables are seen too, where no projections cross."""
    figures = measure(shapes(rod(), rod(y=1.7 * RADIUS)))
    assert figures.cable_penetration == pytest.approx(0.3, abs=1e-6)
    assert find_fault(figures) is not None


def test_a_cable_in_the_floor_is_refused() -> None:
    """Half sunk."""
    assert "floor penetration" in str(find_fault(measure(shapes(rod(z=0.5 * RADIUS)))))


def test_a_floating_cable_is_refused() -> None:
    """One radius of air below it."""
    assert "gap below" in str(find_fault(measure(shapes(rod(z=2 * RADIUS)))))


def test_a_cable_carried_by_another_does_not_float() -> None:
    """The gap is measured to whatever lies below."""
    figures = measure(shapes(rod(), rod(z=3 * RADIUS, along_y=True)))
    assert figures.support_gap == pytest.approx(0.0, abs=1e-9)


def test_a_cable_that_went_through_another_is_found() -> None:
    """The one that started above lies below."""
    figures = measure(shapes(rod(z=3 * RADIUS), rod(along_y=True)))
    assert figures.pass_throughs == 1
    assert "passed through" in str(find_fault(figures))


def test_the_order_of_start_decides_what_is_above() -> None:
    """The same shapes are sound if the cables started the other way round."""
    assert measure(shapes(rod(z=3 * RADIUS), rod(along_y=True), order=(1, 0))).pass_throughs == 0


def test_a_stretched_cable_is_refused() -> None:
    """2 % longer than at rest."""
    stretched = rod()
    stretched[:, 0] *= 1.02
    figures = measure(shapes(stretched))
    assert figures.length_error == pytest.approx(0.02)
    assert "length error" in str(find_fault(figures))


def test_a_moving_cable_is_refused() -> None:
    """6 mm/s at capture."""
    assert "speed" in str(find_fault(measure(shapes(rod(), speed=0.006))))


def test_a_cable_that_crosses_itself_is_refused() -> None:
    """A loop of 20 mm in an otherwise straight cable."""
    t = np.linspace(-1.0, 1.0, 41)
    loop = np.stack([0.02 * (t**3 - 0.3 * t) / 0.3, 0.02 * (1 - t**2), np.full_like(t, RADIUS)], axis=1)
    looped = shapes(loop)
    lengths = np.array([np.linalg.norm(np.diff(loop, axis=0), axis=1).sum()])
    figures = measure(replace(looped, lengths_m=lengths))
    assert figures.self_crossings == 1
    assert "crosses itself" in str(find_fault(figures))


def test_a_gentle_bend_is_no_crossing() -> None:
    """Neighbouring segments share a point and do not cross."""
    assert measure(shapes(rod())).self_crossings == 0
