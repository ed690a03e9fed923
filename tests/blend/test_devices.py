"""Devices that Cycles may render on."""

from pathlib import Path

import pytest

pytest.importorskip("bpy")

from blend.devices import GPU_CHOICES, choose_device
from farm.run.worker_settings import DeviceChoice

pytestmark = pytest.mark.blender


def test_auto_tries_every_gpu_that_can_be_named() -> None:
    """A backend that can be asked for by name is found by `auto`, too."""
    assert {*GPU_CHOICES, DeviceChoice.AUTO, DeviceChoice.CPU} == set(DeviceChoice)


def test_the_cpu_can_always_be_chosen() -> None:
    """Whatever the machine has."""
    assert choose_device(DeviceChoice.CPU) == "cpu"


@pytest.mark.skipif(
    any([*Path("/dev").glob("nvidia[0-9]"), *Path("/dev").glob("kfd")]), reason="needs a machine without a GPU"
)
def test_auto_falls_back_to_the_cpu() -> None:
    """On a machine without a GPU."""
    assert choose_device(DeviceChoice.AUTO) == "cpu"
