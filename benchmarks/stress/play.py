"""Play one run of the stress test, and follow it step by step."""

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from benchmarks.physics.gates import StressFault, stress_fault
from benchmarks.physics.passes import PassWatch
from benchmarks.stress.scenes import Case
from benchmarks.stress.starts import Setting, set_up
from farm.dataset.manifest import SettleFigures
from farm.scene.physics import GRAVITY_M_S2
from worker.simulate.checks.measure import Gate, measure, settled_figures
from worker.simulate.rod.fall import REST_FASTEST_M_S, REST_RMS_M_S, REST_S
from worker.simulate.rod.simulation import DivergedError, RodSimulation
from worker.simulate.shapes import CableShapes

LOOK_RADII = 0.25
"""Distance, in the least radius, that some node may have moved before passages are looked for."""

STRIDE = 8
"""Steps made at once where the cables are too slow to move `LOOK_RADII` in them."""


@dataclass(frozen=True, slots=True)
class Result:
    """The result of a run.

    Attributes:
        case: the scene.
        fault: reason why the run failed; None if it did not.
        detail: the fault's figure.
        figures: figures of gates 1 to 4; None if the end is not finite or far away.
        passes: number of passages of a cable through another or itself, away from all ends, that stand.
        end_slips: number of such passages close to an end.
        undone: number of passages that were led back.
        sunk_nodes: number of times that a node's middle went below the floor's surface.
        fall_s: simulated time.
        max_time_s: simulated time by which the cables had to rest.
        steps: number of time steps.
        wall_s: time that the run took; it decides nothing.
    """

    case: Case
    fault: StressFault | None
    detail: str
    figures: SettleFigures | None
    passes: int
    end_slips: int
    undone: int
    sunk_nodes: int
    fall_s: float
    max_time_s: float
    steps: int
    wall_s: float

    @property
    def gates(self) -> Mapping[Gate, float]:
        """Gates 1 to 4, with passages counted during the fall and not from the start's order; empty if unmeasured."""
        if self.figures is None:
            return {}
        return {**settled_figures(self.figures), Gate.CABLE_PASS_THROUGH: self.passes}


def play(case: Case) -> Result:
    """Let one scene fall until it rests, its time is over, or the solver breaks down."""
    began = time.perf_counter()
    setting = set_up(case)
    radii = np.array([rod.radius_m for rod in setting.rods])
    simulation = RodSimulation(setting.rods, setting.surroundings, steps_per_s=case.steps)
    for rod, velocity in enumerate(setting.velocities_m_s):
        simulation.set_velocities(rod, np.tile(velocity, (len(setting.rods[rod].nodes_m), 1)))
    watch = PassWatch(tuple(rod.nodes_m for rod in setting.rods), radii)
    broke = ""
    try:
        # Cables that have flown apart may overflow; finding that out is the purpose of the test.
        with np.errstate(over="ignore", invalid="ignore"):
            _follow(simulation, setting, watch)
    except (DivergedError, ArithmeticError, ValueError, MemoryError) as error:
        broke = f"{type(error).__name__} {error}"
    shapes = _shapes(simulation, setting)
    fault = StressFault.NOT_FINITE if broke else stress_fault(shapes, reach_m=setting.reach_m, passes=watch.passes)
    measurable = fault not in {StressFault.NOT_FINITE, StressFault.ESCAPED}
    figures = measure(shapes) if measurable else None
    return Result(
        case=case,
        fault=fault,
        detail=broke or _detail(fault, figures, watch, setting),
        figures=figures,
        passes=watch.passes,
        end_slips=watch.end_slips,
        undone=watch.undone,
        sunk_nodes=watch.sunk_nodes,
        fall_s=simulation.time_s,
        max_time_s=setting.max_time_s,
        steps=simulation.steps,
        wall_s=time.perf_counter() - began,
    )


def _follow(simulation: RodSimulation, setting: Setting, watch: PassWatch) -> None:
    """Advance by one step or a few at a time, with drawn scenes' rule of rest; stop when a cable escapes."""
    rods = range(len(setting.rods))
    look_m = LOOK_RADII * min(rod.radius_m for rod in setting.rods)
    quiet_steps = max(1, round(REST_S / simulation.step_s))
    quiet = 0
    moved = fastest = 0.0
    step_s = simulation.step_s
    while simulation.time_s < setting.max_time_s and quiet < quiet_steps:
        # Over so few steps only gravity speeds slow cables up noticeably, so no passage is missed.
        while_s = STRIDE * step_s
        stride = STRIDE if (fastest + GRAVITY_M_S2 * while_s) * while_s < look_m else 1
        before_s = simulation.time_s
        simulation.advance(stride)
        step_s = (simulation.time_s - before_s) / stride
        squared = np.concatenate([(simulation.velocities_m_s(rod) ** 2).sum(axis=1) for rod in rods])
        rms, fastest = float(np.sqrt(squared.mean())), float(np.sqrt(squared.max()))
        moved += fastest * stride * step_s
        if moved > look_m:
            nodes = tuple(simulation.nodes_m(rod) for rod in rods)
            if max(float(np.abs(each).max()) for each in nodes) > setting.reach_m:
                return
            watch.see(nodes)
            moved = 0.0
        if simulation.time_s < setting.parting_s:
            watch.forget()
        quiet = quiet + stride if rms <= REST_RMS_M_S and fastest <= REST_FASTEST_M_S else 0
    watch.see(tuple(simulation.nodes_m(rod) for rod in rods))


def _shapes(simulation: RodSimulation, setting: Setting) -> CableShapes:
    rods = range(len(setting.rods))
    heights = [float(rod.nodes_m[:, 2].mean()) for rod in setting.rods]
    return CableShapes(
        nodes_m=tuple(simulation.nodes_m(rod) for rod in rods),
        radii_m=np.array([rod.radius_m for rod in setting.rods]),
        lengths_m=np.array([rod.segment_length_m * (len(rod.nodes_m) - 1) for rod in setting.rods]),
        speeds_m_s=tuple(np.linalg.norm(simulation.velocities_m_s(rod), axis=1) for rod in rods),
        start_order=tuple(int(rod) for rod in np.argsort(heights, kind="stable")),
        fall_s=simulation.time_s,
        steps=simulation.steps,
    )


def _detail(fault: StressFault | None, figures: SettleFigures | None, watch: PassWatch, setting: Setting) -> str:
    """The figure that made a run fail, in words; empty without one."""
    if fault is StressFault.ESCAPED:
        return f"farther than {setting.reach_m:.3g} m"
    if fault is None or figures is None:
        return ""
    return {
        StressFault.PASSED_THROUGH: f"{watch.passes} of cables, {figures.floor_pass_throughs} of the floor",
        StressFault.STRETCHED: f"{figures.length_error:.2%}",
        StressFault.NOT_AT_REST: f"{figures.speed_rms_mm_s:.3g} mm/s rms, {figures.speed_max_mm_s:.3g} mm/s at most, "
        f"after {setting.max_time_s:.3g} s",
    }.get(fault, "")
