"""Devices that Cycles may render on."""

from pathlib import Path

import pytest

pytest.importorskip("bpy")

from blend.devices import CHOICES, choose_device
from farm.cli.options import DeviceChoice  # after importorskip

pytestmark = pytest.mark.blender


def test_the_command_line_offers_what_the_worker_knows() -> None:
    """The command line's list of devices equals the worker's, which it doesn't import."""
    assert {str(choice) for choice in DeviceChoice} == set(CHOICES)


def test_the_cpu_can_always_be_chosen() -> None:
    """The CPU can be chosen on every machine."""
    assert choose_device("cpu") == "cpu"


@pytest.mark.skipif(
    any([*Path("/dev").glob("nvidia[0-9]"), *Path("/dev").glob("kfd")]), reason="needs a machine without a GPU"
)
def test_auto_falls_back_to_the_cpu() -> None:
    """On a machine without a GPU, auto chooses the CPU."""
    assert choose_device("auto") == "cpu"
