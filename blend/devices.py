"""Which device Cycles renders on: the CPU, or a GPU through OptiX, CUDA, HIP or oneAPI."""

from typing import Any

import bpy

from farm.errors import MachineError

GPU_BACKENDS = ("OPTIX", "CUDA", "HIP", "ONEAPI")
"""In the order in which `auto` tries them."""

CHOICES = ("auto", "cpu", *(backend.lower() for backend in GPU_BACKENDS))


def choose_device(wanted: str) -> str:
    """Enable a device for Cycles in this process.

    Args:
        wanted: one of `CHOICES`; `auto` takes the first GPU backend that has a device, else the CPU.

    Returns:
        The choice made, "cpu" or a backend in lower case.

    Raises:
        MachineError: if the choice is unknown or this machine has no such device.
    """
    if wanted not in CHOICES:
        raise MachineError(f"--device {wanted}: unknown; choose one of {', '.join(CHOICES)}")
    if wanted == "cpu":
        return "cpu"
    backends = GPU_BACKENDS if wanted == "auto" else (wanted.upper(),)
    for backend in backends:
        if _enable(backend):
            return backend.lower()
    if wanted == "auto":
        return "cpu"
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
