"""The environment of the farm's own processes: what other programs leave in it must not change a picture or a place.

Blender, numba, OpenCV, Celery and others read variables of their own, and studios, shells, schedulers and other farms
set them. Each variable is one of three kinds. *Cleared*: it changes what a picture shows, which files are read or
written, or which Redis is asked, so the farm's processes do not see it (`CLEARED`). *Replaced*: the farm needs a part
of it (`own_environment`). *Kept*: all others, such as HOME, TMPDIR, TZ, proxies and certificates, AWS_* and FSSPEC_*,
FARM_*, and the choice of a graphics device or its driver (CUDA_VISIBLE_DEVICES, ONEAPI_DEVICE_SELECTOR, LIBGL_*,
MESA_*, EGL_*, DISPLAY), which is the machine's own and part of no picture's description.
"""

import os
import sys
from collections.abc import Iterable, Mapping, MutableMapping
from fnmatch import fnmatchcase
from pathlib import Path

CLEARED: Mapping[str, tuple[str, ...]] = {
    "Blender: resources, scripts and colour management of another installation": ("BLENDER_*",),
    "Cycles: kernels, shaders and instruction sets": ("CYCLES_*", "CUDA_BIN_PATH", "NVIDIA_TF32_OVERRIDE"),
    "Cycles on oneAPI: how its kernels are compiled": ("SYCL_PROGRAM_*", "SYCL_DEVICELIB_*", "SYCL_USE_KERNEL_SPV"),
    "OpenColorIO: the configuration of a studio's colours": ("OCIO", "OCIO_*"),
    "OpenImageIO: options of readers, plug-ins, threads": ("OPENIMAGEIO_*", "OIIO_*", "CUE_THREADS"),
    "readers of pictures in several libraries": ("LIBTIFF_*", "JSIMD_*", "PILLOW_*"),
    "Open Image Denoise: device, weights, instruction set": ("OIDN_*",),
    "Embree, oneTBB, OSL, USD and MaterialX": ("EMBREE_*", "TBB_*", "OSL_*", "PXR_*", "MATERIALX_*"),
    "numba: the interpreter instead of the compiler, other optimisation": ("NUMBA_*", "LLVMLITE_*"),
    "NumPy and SciPy: instruction sets and backends": ("NPY_*", "NUMPY_*", "SCIPY_*"),
    "OpenMP and BLAS: threads and kernels, and with them the order of sums": (
        *("OMP_*", "GOMP_*", "KMP_*", "OPENBLAS_*", "GOTO_NUM_THREADS", "MKL_*", "BLIS_*"),
    ),
    "OpenCV: limits of pictures, instruction sets, OpenCL": ("OPENCV_*",),
    "Python: another library, stripped assertions, warnings as errors": ("PYTHON*",),
    "Celery and what it is made of: the Redis of another program, its loader, its signals": (
        *("CELERY_*", "KOMBU_*", "BROKER_URL", "RESULT_BACKEND", "DJANGO_SETTINGS_MODULE", "DJANGO_PROJECT_DIR"),
        *("REMAP_SIGTERM", "AUTOSCALE_KEEPALIVE", "EVENTLET_NOBLOCK", "WORKER_LOGLEVEL", "DISABLE_TRACEBACKS"),
        *("C_FORCE_ROOT", "C_FAKEFORK", "C_REMDEBUG", "C_IMPDEBUG", "C_WNOCONF", "C_STRICT_APP", "C_WARN_APP"),
        *("FORKED_BY_MULTIPROCESSING", "MULTIPROCESSING_FORKING_DISABLE", "_MP_FORK_*", "MP_LOG", "MP_MAIN_FILE"),
        *("PICKLE_PROTOCOL", "USE_FAST_LOCALS"),
    ),
    "Flower: the settings of another Flower": ("FLOWER_*",),
    "the loader of programs: functions of the C library in other versions": (
        *("LD_PRELOAD", "LD_AUDIT", "GLIBC_TUNABLES"),
    ),
    "the locale: the decimal comma, sorting, and the words of messages": ("LC_*", "LANG", "LANGUAGE"),
}
"""Patterns of the names of cleared variables, under the program that reads them and what they change."""

_OWN = frozenset({"FLOWER_BASIC_AUTH", "PYTHONPATH"})
"""Names that a pattern matches and that are the farm's own: the first is documented, and `farm.start` reads the other
for what it puts behind the farm's own packages. An isolated interpreter doesn't look at it."""

_PATTERNS = tuple(pattern for patterns in CLEARED.values() for pattern in patterns)


def is_cleared(name: str) -> bool:
    """Whether the farm's processes do not see this variable."""
    return name not in _OWN and any(fnmatchcase(name, pattern) for pattern in _PATTERNS)


def own_environment(environment: Mapping[str, str] = os.environ) -> dict[str, str]:
    """Build the environment of one of the farm's own processes.

    Args:
        environment: environment to begin with.

    Returns:
        It without what other programs left. The encoding of names stays that of the user's locale, all else of a locale
        is the C library's own. LD_LIBRARY_PATH loses those folders that hold a library of Blender's or OpenImageIO's
        names, which would be loaded in place of theirs. Blender reads no settings of the user: below their folder lie a
        person's scripts and colours.
    """
    own = {name: value for name, value in environment.items() if not is_cleared(name)}
    # The order in which the C library looks; the farm's files keep the names that this user sees.
    encoding = next(filter(None, map(environment.get, ("LC_ALL", "LC_CTYPE", "LANG"))), None)
    if encoding:
        own["LC_CTYPE"] = encoding
    own["XDG_CONFIG_HOME"] = os.devnull
    if folders := own.pop("LD_LIBRARY_PATH", ""):
        harmless = _without_libraries(folders.split(os.pathsep), _bundled_libraries())
        if harmless:
            own["LD_LIBRARY_PATH"] = os.pathsep.join(harmless)
    return own


def clear(environment: MutableMapping[str, str] = os.environ) -> None:
    """Make the environment of this process one of the farm's own; libraries that are loaded later see it."""
    own = own_environment(environment)
    for name in set(environment) - set(own):
        del environment[name]
    for name, value in own.items():
        if environment.get(name) != value:
            environment[name] = value


def _bundled_libraries() -> frozenset[str]:
    # Libraries of other wheels have a checksum in their names.
    folders = (Path(entry, name) for entry in sys.path for name in ("bpy/lib", "OpenImageIO/lib"))
    return frozenset(name for folder in folders for name in _names(folder) if ".so" in name)


def _without_libraries(folders: Iterable[str], names: frozenset[str]) -> list[str]:
    # An empty entry is the working folder.
    return [folder for folder in folders if names.isdisjoint(_names(Path(folder or os.curdir)))]


def _names(folder: Path) -> set[str]:
    try:
        return set(os.listdir(folder))  # noqa: PTH208 - names alone are wanted
    except OSError:
        return set()
