"""What simulators are granted."""

import pytest

from farm.spec.simulation import Simulator
from worker.simulate.checks.measure import Gate
from worker.simulate.grants import grants_of


@pytest.mark.parametrize("simulator", Simulator)
def test_every_simulator_states_its_grants(simulator: Simulator) -> None:
    """Each is a target within the bound of its gate, above the gate's own."""
    for gate, target in grants_of(simulator).items():
        assert gate.value.target < target <= gate.value.never


def test_the_rods_have_the_gates_own_targets() -> None:
    """They are set for the rods."""
    assert not grants_of(Simulator.ROD)


def test_the_cloth_is_granted_length_and_the_cantilever() -> None:
    """0.5 % against 0.1 % of length, and 5 % against 1 % of H/W."""
    assert grants_of(Simulator.CLOTH) == {Gate.LENGTH: 0.005, Gate.CANTILEVER: 0.05}
