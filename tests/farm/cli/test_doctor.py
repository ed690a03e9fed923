"""The findings of `farm doctor`."""

from importlib import import_module
from pathlib import Path

import pytest

from farm.cli.doctor import examine

doctor = import_module("farm.cli.doctor")  # the package's own name `doctor` is the command


@pytest.fixture(autouse=True)
def no_blender_started(monkeypatch: pytest.MonkeyPatch) -> None:
    """Skip the check that starts Blender, which takes seconds; other tests run it for real."""
    monkeypatch.setattr(doctor, "_blender", lambda: doctor.Check(name="Blender", ok=True, needed=True, detail="4.5"))


def test_every_lack_has_a_remedy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """For everything that is missing the remedy is a command; nothing else has one."""
    monkeypatch.setattr(doctor, "find_redis_server", lambda: None)
    monkeypatch.setenv("FARM_ASSETS", str(tmp_path))
    checks = examine(tmp_path)
    assert all(check.ok != bool(check.remedy) for check in checks)
    assert not next(check for check in checks if check.name == "redis-server").ok
    assert not next(check for check in checks if check.name == "built-in surfaces").ok


@pytest.mark.parametrize(
    ("device", "backend"), [("nvidia0", "optix or cuda"), ("kfd", "hip"), ("dri/renderD128", "oneapi"), (None, "CPU")]
)
def test_gpu(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, device: str | None, backend: str) -> None:
    """The kernel's devices tell which backends are worth a try."""
    monkeypatch.setattr(doctor, "_DEVICES", tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    if device is not None:
        (tmp_path / device).parent.mkdir(exist_ok=True)
        (tmp_path / device).touch()
    assert backend in doctor._gpu().detail


def test_eevee_needs_a_driver(monkeypatch: pytest.MonkeyPatch) -> None:
    """EGL without a driver is reported, with the package that holds one."""
    monkeypatch.setattr("ctypes.CDLL", lambda _: None)
    monkeypatch.setattr(doctor, "_DRIVERS", ("nowhere/*.so",))
    assert doctor._egl().remedy.endswith("libgl1-mesa-dri")
    monkeypatch.setattr(doctor, "_DRIVERS", ("etc/passwd",))
    assert doctor._egl().ok


def test_missing_libraries_are_named_with_their_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A library that the loader doesn't find is reported with Debian's package."""
    ldd = tmp_path / "ldd"
    ldd.write_text("#!/bin/sh\necho '\tlibXi.so.6 => not found'\necho '\tlibc.so.6 => /lib/libc.so.6'\n")
    ldd.chmod(0o755)
    module = tmp_path / "__init__.so"
    module.write_bytes(b"")
    monkeypatch.setattr(doctor, "_blender_libraries", lambda: [module])
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    check = next(check for check in examine(tmp_path) if check.name == "libraries for Blender")
    assert not check.ok
    assert check.detail == "missing: libXi.so.6"
    assert check.remedy.endswith("libxi6")
