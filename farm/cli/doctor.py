"""`farm doctor`: tells what this machine has and lacks for rendering."""

import ctypes
import importlib.util
import platform
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import typer
from pydantic_core import to_json
from rich.markup import escape

from assets.surfaces.baked import load_baked, surface_directory
from assets.surfaces.catalogue import SURFACES
from farm.cli.display import console
from farm.cli.options import AsJson, Broker
from farm.environment import own_environment
from farm.errors import AssetError, BrokerError, MachineError
from farm.local.redis_server import find_redis_server
from farm.machine import memory_bytes, usable_cores
from farm.model import Model
from farm.run.queue.broker import as_broker_error, broker_url, connect_to_write, is_named, policy_of


def doctor(broker: Broker = None, as_json: AsJson = False) -> None:
    """Tell what this machine has and lacks, and the command that installs what is missing."""
    screen = console(results=True)
    with console().status("looking"):
        checks = examine(Path.cwd())
        if broker is not None or is_named():
            checks.append(examine_redis(broker))
    if as_json:
        typer.echo(to_json([check.model_dump() for check in checks], indent=1).decode())
    else:
        for check in checks:
            mark = "[green]ok     [/]" if check.ok else "[red]missing[/]" if check.needed else "[yellow]lacking[/]"
            screen.print(f"{mark}  {check.name}: {escape(check.detail)}")
            if check.remedy:
                screen.print(f"         -> {escape(check.remedy)}")
    missing = [check.name for check in checks if check.needed and not check.ok]
    if missing:
        raise MachineError(f"this machine can't render yet; it lacks {', '.join(missing)}")


_MEMORY_GIB = 4.0
"""Memory, in GiB, below which the doctor advises a single worker."""

_DISK_GIB = 2.0
"""Free disk space, in GiB, below which the doctor advises another disk."""

_BLENDER_S = 120.0
"""Time, in seconds, after which Blender's module counts as not starting; it is large for slow disks."""

_DEVICES = Path("/dev")

_GPU_SIGNS = (
    ("optix or cuda", "nvidia[0-9]*", "NVIDIA"),
    ("hip", "kfd", "AMD"),
    ("oneapi or hip", "dri/renderD*", "a render node"),
)
"""GPU backends of Cycles, each with the pattern of its device files below `_DEVICES` and the name shown for it."""

# Paths below the root of Mesa's EGL drivers, in older and newer packages, and of NVIDIA's.
_DRIVERS = (
    "usr/lib/*/dri/swrast_dri.so",
    "usr/lib/*/dri/libdril_dri.so",
    "usr/lib/*/libgallium-*.so",
    "usr/lib/*/libEGL_nvidia.so.0",
)


# The libraries that bpy is linked to, and the Debian package that holds each.
_PACKAGES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libGLX.so.0": "libglx0",
    "libICE.so.6": "libice6",
    "libSM.so.6": "libsm6",
    "libX11.so.6": "libx11-6",
    "libXext.so.6": "libxext6",
    "libXfixes.so.3": "libxfixes3",
    "libXi.so.6": "libxi6",
    "libXrender.so.1": "libxrender1",
    "libxkbcommon.so.0": "libxkbcommon0",
}


class Check(Model):
    """The result of one check of the machine.

    Attributes:
        name: name of what was looked for.
        ok: whether the machine has it, or enough of it.
        needed: whether every rendering needs it; what is not needed serves some uses only.
        detail: what was found, such as a version, a size or an error.
        remedy: command that installs or mends it; empty if `ok`.
    """

    name: str
    ok: bool
    needed: bool
    detail: str
    remedy: str = ""


def examine(folder: Path) -> list[Check]:
    """Check this machine.

    Args:
        folder: folder on the disk whose free space is measured.

    Returns:
        The results, in the order in which they are shown.
    """
    return [
        _python(),
        _libraries(),
        _blender(),
        _redis_server(),
        _surfaces(),
        _egl(),
        _gpu(),
        _flower(),
        _cores(),
        _memory(),
        _disk(folder),
    ]


def _python() -> Check:
    version = platform.python_version()
    ok = sys.version_info[:2] == (3, 11)
    return Check(
        name="Python 3.11", ok=ok, needed=True, detail=version, remedy="" if ok else "apt-get install python3.11-venv"
    )


def _blender_libraries() -> Sequence[Path]:
    spec = importlib.util.find_spec("bpy")
    if spec is None or spec.origin is None:
        return ()
    return sorted(Path(spec.origin).parent.glob("__init__*.so"))


def _libraries() -> Check:
    name = "libraries for Blender"
    modules = _blender_libraries()
    ldd = shutil.which("ldd")
    if not modules or ldd is None:
        return Check(name=name, ok=True, needed=True, detail="not checked: no bpy, or no ldd")
    listing = subprocess.run(  # noqa: S603 - a program of the system on a file of our own
        [ldd, str(modules[0])], capture_output=True, text=True, check=False
    ).stdout
    missing = [line.split()[0] for line in listing.splitlines() if line.rstrip().endswith("not found")]
    if not missing:
        return Check(name=name, ok=True, needed=True, detail="all found")
    packages = sorted({_PACKAGES.get(library, library) for library in missing})
    remedy = f"apt-get install --no-install-recommends {' '.join(packages)}"
    return Check(name=name, ok=False, needed=True, detail=f"missing: {', '.join(missing)}", remedy=remedy)


def _blender() -> Check:
    name = "Blender (bpy)"
    if importlib.util.find_spec("bpy") is None:
        remedy = "pip install 'cable-farm[worker]'"
        return Check(name=name, ok=False, needed=True, detail="not installed", remedy=remedy)
    # It looks where this process looks, which may have been put in order.
    program = f"import sys; sys.path[:] = {sys.path!r}; import bpy; print('version', bpy.app.version_string)"
    try:
        result = subprocess.run(  # noqa: S603 - our own program
            [sys.executable, "-I", "-c", program],
            env=own_environment(),
            capture_output=True,
            text=True,
            check=False,
            timeout=_BLENDER_S,
        )
    except subprocess.TimeoutExpired:
        return Check(
            name=name, ok=False, needed=True, detail="does not start", remedy="pip install --force-reinstall bpy"
        )
    versions = [line for line in result.stdout.splitlines() if line.startswith("version ")]
    if result.returncode == 0 and versions:
        return Check(name=name, ok=True, needed=True, detail=versions[-1].removeprefix("version "))
    last = result.stderr.strip().splitlines()[-1:] or [f"it ended with code {result.returncode}"]
    return Check(name=name, ok=False, needed=True, detail=last[0], remedy="mend the libraries above, then try again")


def _redis_server() -> Check:
    found = find_redis_server()
    remedy = "" if found else "pip install 'cable-farm[local]', or apt-get install redis-server"
    detail = str(found) if found else "not found; farm run needs it"
    # Only `farm run` starts a Redis; workers and coordinators of a cluster get the address of one.
    return Check(name="redis-server", ok=found is not None, needed=False, detail=detail, remedy=remedy)


def examine_redis(broker: str | None) -> Check:
    """Check the Redis that a farm of many machines shares.

    Args:
        broker: its address; None for that of the environment.

    Returns:
        Whether it takes writes, and forgets none of them by itself.
    """
    name = "Redis"
    try:
        with connect_to_write(broker_url(broker)) as client, as_broker_error():
            policy = policy_of(client)
    except BrokerError as error:
        return Check(name=name, ok=False, needed=False, detail=str(error), remedy="see docs/operations.md, Addresses")
    if policy is None:
        detail = "takes writes; its access list hides what it does when it is full"
        return Check(name=name, ok=True, needed=False, detail=detail)
    if policy != "noeviction":
        detail = f"takes writes, but when it is full it forgets keys, and jobs with them (maxmemory-policy {policy})"
        remedy = "redis-cli CONFIG SET maxmemory-policy noeviction"
        return Check(name=name, ok=False, needed=False, detail=detail, remedy=remedy)
    return Check(name=name, ok=True, needed=False, detail="takes writes, and keeps them when it is full")


def _surfaces() -> Check:
    name, folder = "built-in surfaces", surface_directory()
    try:
        present = set(load_baked(folder))
    except AssetError:
        present = set()
    lacking = len(SURFACES.keys() - present)
    detail = f"{len(SURFACES) - lacking} of {len(SURFACES)} drawn, in {folder}"
    # Not needed, as every command that renders draws them first.
    return Check(name=name, ok=lacking == 0, needed=False, detail=detail, remedy="farm assets build" if lacking else "")


def _egl() -> Check:
    try:
        ctypes.CDLL("libEGL.so.1")
    except OSError:
        remedy = "apt-get install --no-install-recommends libegl1 libgl1-mesa-dri"
        return Check(name="EGL", ok=False, needed=False, detail="not found; --engine eevee needs it", remedy=remedy)
    if not any(list(Path("/").glob(pattern)) for pattern in _DRIVERS):
        remedy = "apt-get install --no-install-recommends libgl1-mesa-dri"
        detail = "found, but no driver for it; --engine eevee needs one"
        return Check(name="EGL", ok=False, needed=False, detail=detail, remedy=remedy)
    return Check(name="EGL", ok=True, needed=False, detail="found with a driver, for --engine eevee")


def _gpu() -> Check:
    # Only Blender knows whether Cycles can use a GPU; this quick look tells which backends are worth a try.
    found = [
        f"{backend} ({sign})"
        for backend, pattern, sign in _GPU_SIGNS
        if list(_DEVICES.glob(pattern)) or (sign == "NVIDIA" and shutil.which("nvidia-smi"))
    ]
    detail = f"may serve --device {'; '.join(found)}" if found else "none found; Cycles renders on the CPU"
    return Check(name="GPU", ok=True, needed=False, detail=detail)


def _flower() -> Check:
    ok = importlib.util.find_spec("flower") is not None
    remedy = "" if ok else "pip install 'cable-farm[flower]'"
    return Check(name="Flower", ok=ok, needed=False, detail="installed" if ok else "not installed", remedy=remedy)


def _cores() -> Check:
    count = usable_cores()
    return Check(name="processor cores", ok=True, needed=False, detail=str(count))


def _memory() -> Check:
    total_gib = memory_bytes() / 2**30
    ok = total_gib >= _MEMORY_GIB
    remedy = "" if ok else "farm run --workers 1"
    return Check(name="memory", ok=ok, needed=False, detail=f"{total_gib:.1f} GiB", remedy=remedy)


def _disk(folder: Path) -> Check:
    free_gib = shutil.disk_usage(folder).free / 2**30
    ok = free_gib >= _DISK_GIB
    remedy = "" if ok else "free some, or choose an --out on another disk"
    return Check(name="free disk", ok=ok, needed=False, detail=f"{free_gib:.0f} GiB at {folder}", remedy=remedy)
