"""Play one run of the stress test, and follow it step by step."""

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from benchmarks.physics.gates import StressFault, stress_fault
from benchmarks.physics.passes import PassWatch
from benchmarks.stress.scenes import MOST_STEPS, Case
from benchmarks.stress.starts import Setting, set_up
from benchmarks.stress.watched import WatchedSimulation
from farm.dataset.manifest import SettleFigures
from worker.simulate.checks.measure import Gate, measure, settled_figures
from worker.simulate.rod.fall import REST_FASTEST_M_S, REST_RMS_M_S, REST_S
from worker.simulate.rod.simulation import DivergedError, RodSimulation, TooManyStepsError
from worker.simulate.shapes import CableShapes


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
        cut: whether the steps that a run may make were over before the cables rested. Whether they would have rested,
            and how deep they would have lain, is unknown then, and no fault.
        cpu_s: processor's time that the run took; it decides nothing.
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
    cut: bool
    cpu_s: float

    @property
    def gates(self) -> Mapping[Gate, float]:
        """Gates 1 to 4, with passages counted during the fall and not from the start's order; empty if unmeasured."""
        if self.figures is None:
            return {}
        return {**settled_figures(self.figures), Gate.CABLE_PASS_THROUGH: self.passes}


def play(case: Case, most_steps: int = MOST_STEPS) -> Result:
    """Let one scene fall until it rests, its time or its steps are over, or the solver breaks down."""
    began = time.process_time()
    setting = set_up(case)
    simulation = WatchedSimulation(
        setting.rods,
        setting.surroundings,
        steps_per_s=case.steps,
        reach_m=setting.reach_m,
        parting_s=setting.parting_s,
    )
    for rod, velocity in enumerate(setting.velocities_m_s):
        simulation.set_velocities(rod, np.tile(velocity, (len(setting.rods[rod].nodes_m), 1)))
    watch = simulation.watch
    broke, cut = "", False
    try:
        # Cables that have flown apart may overflow; finding that out is the purpose of the test.
        with np.errstate(over="ignore", invalid="ignore"):
            simulation.settle(
                rms_m_s=REST_RMS_M_S,
                fastest_m_s=REST_FASTEST_M_S,
                quiet_s=REST_S,
                max_time_s=setting.max_time_s,
                max_steps=most_steps,
            )
    except TooManyStepsError:
        cut = True
    except (DivergedError, ArithmeticError, ValueError, MemoryError) as error:
        broke = f"{type(error).__name__} {error}"
    shapes = _shapes(simulation, setting)
    fault = StressFault.NOT_FINITE if broke else stress_fault(shapes, reach_m=setting.reach_m, passes=watch.passes)
    if cut and fault in {StressFault.PENETRATED, StressFault.NOT_AT_REST}:
        fault = None
    if cut and fault is StressFault.PASSED_THROUGH and watch.passes == 0:
        # A cable that starts deep within the floor is not out of it yet.
        fault = None
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
        cut=cut,
        cpu_s=time.process_time() - began,
    )


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
        StressFault.PENETRATED: f"{figures.cable_penetration:.3g} of the radius, "
        f"{figures.floor_penetration:.3g} in the floor",
        StressFault.NOT_AT_REST: f"{figures.speed_rms_mm_s:.3g} mm/s rms, {figures.speed_max_mm_s:.3g} mm/s at most, "
        f"after {setting.max_time_s:.3g} s",
    }.get(fault, "")
