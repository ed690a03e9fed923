"""Devices that Cycles may render on."""

import pytest

pytest.importorskip("bpy")

from farm.cli.options import DeviceChoice  # after importorskip
from worker.devices import CHOICES, choose_device

pytestmark = pytest.mark.blender


def test_the_command_line_offers_what_the_worker_knows() -> None:
    """The two lists agree, though the command line does not import the worker."""
    assert {str(choice) for choice in DeviceChoice} == set(CHOICES)


def test_the_cpu_can_always_be_chosen() -> None:
    """Whatever the machine has."""
    assert choose_device("cpu") == "cpu"


def test_auto_finds_a_device() -> None:
    """A GPU if there is one, else the CPU."""
    assert choose_device("auto") in set(CHOICES) - {"auto"}
