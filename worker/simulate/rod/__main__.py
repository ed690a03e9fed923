"""`python -m worker.simulate.rod`: compiles the rod solver and keeps it on disk, so that no worker has to."""

import sys

import numpy as np

from worker.simulate.rod.compiled import kept_in
from worker.simulate.rod.model import Breeze, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation


def main() -> int:
    """Let two crossed rods fall in a wind, which calls every compiled function."""
    along = np.stack([np.linspace(-0.02, 0.02, 9), np.zeros(9), np.full(9, 0.002)], axis=1)
    across = along[:, [1, 0, 2]] + np.array([0.0, 0.0, 0.003])
    rods = [
        Rod(nodes_m=nodes, radius_m=0.001, youngs_modulus_pa=1e7, density_kg_m3=1500.0) for nodes in (along, across)
    ]
    breeze = Breeze(velocity_m_s=np.array([0.1, 0.0, 0.0]), gusts=np.zeros((0, 3)), until_s=0.01)
    simulation = RodSimulation(rods, Surroundings(breeze=breeze), steps_per_s=1000)
    simulation.settle(rms_m_s=1e-3, fastest_m_s=5e-3, quiet_s=0.01, max_time_s=0.1)
    sys.stdout.write(f"the rod solver is compiled, in {kept_in()}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
