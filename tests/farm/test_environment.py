"""The environment of the farm's own processes."""

import os
import sys
from pathlib import Path

import pytest

from farm.environment import CLEARED, clear, own_environment

HOSTILE = (
    *("OCIO", "OCIO_ACTIVE_VIEWS", "BLENDER_USER_CONFIG", "BLENDER_SYSTEM_SCRIPTS", "BLENDER_USER_RESOURCES"),
    *("CYCLES_KERNEL_PATH", "CYCLES_CPU_NO_AVX2", "CYCLES_SHADER_PATH", "OIDN_DEFAULT_DEVICE", "OPENIMAGEIO_OPTIONS"),
    *(
        "OIIO_LIBRARY_PATH",
        "LIBTIFF_STRILE_ARRAY_MAX_RESIZE_COUNT",
        "NUMBA_DISABLE_JIT",
        "NUMBA_OPT",
        "NUMBA_CACHE_DIR",
    ),
    *("NPY_DISABLE_CPU_FEATURES", "OPENBLAS_CORETYPE", "OMP_NUM_THREADS", "MKL_CBWR", "OPENCV_IO_MAX_IMAGE_PIXELS"),
    *("OPENCV_CPU_DISABLE", "PYTHONHOME", "PYTHONOPTIMIZE", "PYTHONSTARTUP", "PYTHONWARNINGS", "PYTHONHASHSEED"),
    *("CELERY_BROKER_URL", "CELERY_BROKER_READ_URL", "CELERY_RESULT_BACKEND", "CELERY_CONFIG_MODULE", "CELERY_LOADER"),
    *("BROKER_URL", "DJANGO_SETTINGS_MODULE", "REMAP_SIGTERM", "FORKED_BY_MULTIPROCESSING", "KOMBU_LOG_DEBUG"),
    *("FLOWER_UNIX_SOCKET", "FLOWER_PORT", "FLOWER_CONF", "LD_PRELOAD", "GLIBC_TUNABLES", "LC_NUMERIC", "LC_ALL"),
)

KEPT = (
    *("HOME", "PATH", "TMPDIR", "TZ", "USER", "TERM", "COLUMNS", "NO_COLOR", "DISPLAY", "XDG_CACHE_HOME"),
    *("http_proxy", "HTTPS_PROXY", "NO_PROXY", "SSL_CERT_FILE", "AWS_ACCESS_KEY_ID", "AWS_ENDPOINT_URL", "AWS_PROFILE"),
    *("FSSPEC_S3_ENDPOINT_URL", "GOOGLE_APPLICATION_CREDENTIALS", "CUDA_VISIBLE_DEVICES", "HIP_VISIBLE_DEVICES"),
    *("ONEAPI_DEVICE_SELECTOR", "LIBGL_ALWAYS_SOFTWARE", "FARM_BROKER_URL", "FARM_ASSETS", "FARM_COMPILED"),
    *("FLOWER_BASIC_AUTH", "PYTHONPATH"),
)


@pytest.mark.parametrize("name", HOSTILE)
def test_what_others_left_is_gone(name: str) -> None:
    """A variable that changes a picture, a file's place or the Redis doesn't reach the farm's processes."""
    assert name not in own_environment({name: "x", "PATH": "/bin"})


@pytest.mark.parametrize("name", KEPT)
def test_what_people_need_stays(name: str) -> None:
    """A variable that names folders, credentials, proxies, a device or the farm's own settings stays as it is."""
    assert own_environment({name: "x"})[name] == "x"


def test_every_group_is_tried() -> None:
    """Each group of patterns has a name in this table; one without would be untested."""
    assert [group for group, patterns in CLEARED.items() if not _tried(patterns)] == []


def _tried(patterns: tuple[str, ...]) -> bool:
    untested = {"EMBREE_*": "EMBREE_X", "SYCL_PROGRAM_*": "SYCL_PROGRAM_COMPILE_OPTIONS"}
    names = (*HOSTILE, *untested.values())
    return any(name == pattern or name.startswith(pattern.removesuffix("*")) for pattern in patterns for name in names)


@pytest.mark.parametrize(
    ("given", "encoding"),
    [
        ({"LC_ALL": "de_DE.UTF-8", "LC_CTYPE": "C", "LANG": "C"}, "de_DE.UTF-8"),
        ({"LC_CTYPE": "fr_FR.ISO-8859-1", "LANG": "C"}, "fr_FR.ISO-8859-1"),
        ({"LC_ALL": "", "LANG": "C.UTF-8"}, "C.UTF-8"),
        ({}, None),
    ],
)
def test_of_a_locale_the_encoding_stays(given: dict[str, str], encoding: str | None) -> None:
    """Names of files mean the same as for the user, while decimal commas and sorting are the C library's own."""
    own = own_environment({**given, "LC_NUMERIC": "de_DE.UTF-8"})
    assert {name: value for name, value in own.items() if name.startswith(("LC_", "LANG"))} == (
        {} if encoding is None else {"LC_CTYPE": encoding}
    )


def test_blender_reads_no_settings_of_the_user() -> None:
    """The folder below which a person's scripts and colour management lie can't exist for the farm's processes."""
    folder = own_environment({"XDG_CONFIG_HOME": "/home/me/.config"})["XDG_CONFIG_HOME"]
    with pytest.raises(NotADirectoryError):
        os.stat(Path(folder, "blender"))  # noqa: PTH116 - pathlib hides which error it is


def test_foreign_libraries_of_blenders_names_stay_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """LD_LIBRARY_PATH keeps a driver's folder and loses one whose library would be loaded for Blender's own."""
    for place in ("site-packages/bpy/lib", "drivers", "studio"):
        (tmp_path / place).mkdir(parents=True)
    (tmp_path / "site-packages/bpy/lib/libtbb.so.12").touch()
    (tmp_path / "studio/libtbb.so.12").touch()
    (tmp_path / "drivers/libcuda.so.1").touch()
    monkeypatch.setattr(sys, "path", [str(tmp_path / "site-packages")])
    given = os.pathsep.join(str(tmp_path / name) for name in ("studio", "drivers", "nowhere"))
    own = own_environment({"LD_LIBRARY_PATH": given})
    assert own["LD_LIBRARY_PATH"] == os.pathsep.join(str(tmp_path / name) for name in ("drivers", "nowhere"))


def test_a_process_clears_its_own() -> None:
    """In place, what is foreign goes, and all else is as it was."""
    environment = {"OCIO": "x", "PATH": "/bin", "LC_ALL": "C.UTF-8"}
    clear(environment)
    assert environment == {"PATH": "/bin", "LC_CTYPE": "C.UTF-8", "XDG_CONFIG_HOME": os.devnull}
