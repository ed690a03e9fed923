"""The promises of the images and the compose file, checked in the files; no test starts a container."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

from farm import __version__

_ROOT = Path(__file__).parents[2]
_DOCKER = _ROOT / "docker"
_COMPOSE = yaml.safe_load((_DOCKER / "compose.yaml").read_text())
_GPU = yaml.safe_load((_DOCKER / "compose.gpu.yaml").read_text())
_SERVICES = sorted(_COMPOSE["services"])


def _instructions() -> list[str]:
    text = (_DOCKER / "Dockerfile").read_text().replace("\\\n", " ")
    return [line for line in text.splitlines() if line.strip() and not line.startswith("#")]


def _stages() -> dict[str, list[str]]:
    stages: dict[str, list[str]] = {}
    for line in _instructions():
        if line.startswith("FROM "):
            stages[line.split()[-1]] = []
        stages[next(reversed(stages))].append(line)
    return stages


@pytest.fixture(params=_SERVICES)
def service(request: pytest.FixtureRequest) -> dict[str, Any]:
    """Each service of the compose file, in turn."""
    found: dict[str, Any] = _COMPOSE["services"][request.param]
    return found


def test_a_service_has_no_rights_to_spare(service: dict[str, Any]) -> None:
    """A service isn't root, has no capabilities and can't gain any, and writes only to volumes and /tmp."""
    assert re.fullmatch(r"[1-9]\d*:[1-9]\d*", service["user"])
    assert service["cap_drop"] == ["ALL"]
    assert "no-new-privileges:true" in service["security_opt"]
    assert service["read_only"] is True
    assert not service.get("privileged", False)


def test_a_service_is_published_to_this_host_alone(service: dict[str, Any]) -> None:
    """No port is open to the network around the host."""
    assert all(port.startswith("127.0.0.1:") for port in service.get("ports", ()))


def test_an_image_is_pinned(service: dict[str, Any]) -> None:
    """Each image names a full version, so that none changes unnoticed."""
    assert re.search(r":\d+\.\d+\.\d+", service["image"])


def test_redis_is_out_of_reach_from_outside() -> None:
    """Redis publishes no port, asks for a password and sits in a network without a way out."""
    redis = _COMPOSE["services"]["redis"]
    assert "ports" not in redis
    assert "--requirepass" in redis["command"]
    assert redis["networks"] == ["queue"]
    assert _COMPOSE["networks"]["queue"]["internal"] is True


def test_passwords_come_from_the_environment_alone() -> None:
    """Compose refuses to start without a password; there is no default, and none in the example."""
    services = _COMPOSE["services"]
    command = services["redis"]["command"]
    redis_password, flower_password = r"\$\{FARM_REDIS_PASSWORD:\?[^}]+\}", r"\$\{FARM_FLOWER_PASSWORD:\?[^}]+\}"
    assert re.fullmatch(redis_password, command[command.index("--requirepass") + 1])
    assert re.fullmatch(redis_password, services["redis"]["environment"]["REDISCLI_AUTH"])
    for name in ("coordinator", "worker", "flower"):
        assert re.fullmatch(
            rf"redis://:{redis_password}@redis:6379/0", services[name]["environment"]["FARM_BROKER_URL"]
        )
    assert re.fullmatch(
        rf"\$\{{\w+:\?[^}}]+\}}:{flower_password}", services["flower"]["environment"]["FLOWER_BASIC_AUTH"]
    )
    assert re.findall(r"^\w*PASSWORD=(.*)$", (_DOCKER / ".env.example").read_text(), re.MULTILINE) == ["", ""]


def test_workers_scale() -> None:
    """A worker has no fixed name or port over which two workers would conflict."""
    worker = _COMPOSE["services"]["worker"]
    assert not {"container_name", "hostname", "ports"} & worker.keys()


def test_the_gpu_file_only_adds_to_the_worker() -> None:
    """The override for GPUs leaves the worker's rights as they are."""
    assert _GPU["services"].keys() == {"worker"}
    assert _GPU["services"]["worker"].keys() == {"command", "environment", "deploy"}


def test_the_package_and_the_images_carry_our_version() -> None:
    """The images' tags and the program follow pyproject.toml."""
    version = tomllib.loads((_ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert version == __version__
    ours = {service["image"] for service in _COMPOSE["services"].values() if "build" in service}
    assert ours == {f"cable-farm-coordinator:{version}", f"cable-farm-worker:{version}"}


def test_the_base_image_is_pinned() -> None:
    """Every stage is based on one Python image with its full version, or on another stage."""
    stages = _stages()
    outside = {lines[0].split()[1] for lines in stages.values()} - stages.keys()
    assert len(outside) == 1
    assert re.fullmatch(r"python:3\.11\.\d+-slim-bookworm(@sha256:[0-9a-f]{64})?", outside.pop())


@pytest.mark.parametrize("name", ["coordinator", "worker"])
def test_an_image_runs_as_the_farms_user(name: str) -> None:
    """Even without compose, no image runs as root or through a shell."""
    lines = _stages()[name]
    assert "USER 10001:10001" in lines
    started = [line for line in lines if re.match(r"\s*(CMD|ENTRYPOINT) ", line)]
    assert all(re.match(r'\s*(CMD|ENTRYPOINT) \["', line) for line in started)
    assert any(line.startswith("ENTRYPOINT ") for line in started)


def test_the_worker_image_takes_the_list_of_packages() -> None:
    """The image installs the list that `make setup` checks, and the builder can read the list."""
    installs = [line for line in _instructions() if "apt-get install" in line]
    stages = _stages()
    assert len(installs) == 2
    for stage, install in zip(("environments", "worker"), installs, strict=True):
        assert "docker/debian-packages.txt" in "".join(stages[stage])
        assert re.search(
            r"xargs --arg-file=/tmp/libraries apt-get install --yes --no-install-recommends(\s+&&|$)", install
        )
    assert "!docker/debian-packages.txt" in (_ROOT / ".dockerignore").read_text().splitlines()


def test_every_install_is_held_to_the_constraints() -> None:
    """Every dependency is installed in its tested version."""
    installs = [line for line in _instructions() if "pip install" in line]
    assert installs
    assert all("-c constraints.txt" in line or "--no-deps" in line for line in installs)
