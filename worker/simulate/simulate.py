"""The fall: a drawn scene becomes settled cables, by the simulator that the dataset names.

A simulator is the folder here that bears its name in `farm.spec.simulation.Simulator`. In it the module `fall` lets the
cables fall (`FallModule`), and the module `grants` says which targets the simulator is granted.
"""

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType
from typing import Any, Protocol, cast

from farm.scene.scene import Scene
from farm.spec.simulation import Fall, Simulator
from worker.simulate.shapes import NOTHING_FELL, CableShapes


class FallModule(Protocol):
    """The module `fall` of a simulator's folder."""

    def drop_cables(self, scene: Scene, fall: Any) -> CableShapes:
        """Let the cables of a scene fall until they rest.

        Args:
            scene: the drawn scene; it has a cable, or a stick if the simulator has sticks.
            fall: the simulator's settings, from the field of `Fall` that bears its name.

        Raises:
            SceneError: if the simulator diverges.
        """
        ...


_MODULES: Mapping[Simulator, FallModule] = MappingProxyType(
    {each: cast("FallModule", import_module(f"worker.simulate.{each.value}.fall")) for each in Simulator}
)


def simulate(scene: Scene, simulator: Simulator, fall: Fall) -> CableShapes:
    """Let the cables of a scene fall until they rest; a scene in which nothing falls is not simulated.

    Sticks fall with rods, as rods themselves. Cloth has no sticks, and its cables fall as if there were none.

    Raises:
        SceneError: if the simulator diverges.
    """
    if not scene.cables and not (scene.sticks and simulator is Simulator.ROD):
        return NOTHING_FELL
    return _MODULES[simulator].drop_cables(scene, fall.settings_of(simulator))
