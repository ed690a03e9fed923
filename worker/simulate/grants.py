"""The grants of each simulator: targets that hold for it in place of the gates' own."""

from collections.abc import Mapping
from importlib import import_module

from farm.spec.simulation import Simulator
from worker.simulate.checks.measure import Gate


def grants_of(simulator: Simulator) -> Mapping[Gate, float]:
    """Read the module `grants` of the simulator's folder; empty if all of the gates' own targets hold."""
    grants: Mapping[Gate, float] = import_module(f"worker.simulate.{simulator.value}.grants").GRANTS
    return grants
