"""The fall: a drawn scene becomes settled cables, by the simulator that the dataset names."""

from benchmarks.physics.published_cloth import drop_cables as drop_as_published_cloth
from farm.scene.scene import Scene
from farm.spec.simulation import Fall, Simulator
from worker.simulate.cloth.joined import drop_cables as drop_as_joined_cloth
from worker.simulate.rod.fall import drop_cables as drop_as_rods
from worker.simulate.shapes import CableShapes


def simulate(scene: Scene, simulator: Simulator, fall: Fall) -> CableShapes:
    """Let the cables of a scene fall until they rest.

    Sticks fall with them as rods; cloth has none, and its cables fall as if there were none.

    Raises:
        SceneError: if the simulator diverges.
    """
    match simulator:
        case Simulator.CLOTH:
            return drop_as_joined_cloth(scene, fall.cloth)
        case Simulator.CLOTH_PUBLISHED:
            return drop_as_published_cloth(scene, fall.cloth)
        case Simulator.ROD:
            return drop_as_rods(scene, fall.rod)
