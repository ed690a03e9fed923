"""The device that Cycles renders on: the CPU, or a GPU through OptiX, CUDA, HIP or oneAPI."""

from typing import Any

import bpy

from farm.errors import MachineError
from farm.run.worker_settings import DeviceChoice

GPU_CHOICES = (DeviceChoice.OPTIX, DeviceChoice.CUDA, DeviceChoice.HIP, DeviceChoice.ONEAPI)
"""The choices that name a backend of Cycles, in the order in which `auto` tries them."""


def choose_device(wanted: DeviceChoice) -> str:
    """Enable a device for Cycles in this process.

    Args:
        wanted: device to enable; `auto` takes the first GPU backend that has a device, else the CPU.

    Returns:
        The choice made, "cpu" or a backend in lower case.

    Raises:
        MachineError: if this machine has no such device.
    """
    if wanted is DeviceChoice.CPU:
        return str(DeviceChoice.CPU)
    for choice in GPU_CHOICES if wanted is DeviceChoice.AUTO else (wanted,):
        if _enable(choice.upper()):
            return str(choice)
    if wanted is DeviceChoice.AUTO:
        return str(DeviceChoice.CPU)
    raise MachineError(f"--device {wanted}: Cycles finds no such device here; use --device cpu or auto")


def _enable(backend: str) -> bool:
    preferences: Any = bpy.context.preferences.addons["cycles"].preferences
    try:
        preferences.compute_device_type = backend
    except TypeError:  # this build of Blender has no such backend
        return False
    preferences.refresh_devices()
    found = [device for device in preferences.devices if device.type == backend]
    for device in preferences.devices:
        device.use = device.type == backend
    return bool(found)
