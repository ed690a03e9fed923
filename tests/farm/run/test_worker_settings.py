"""Settings of workers and renderers, as they cross from one program to another."""

import json
import os
from pathlib import Path

import pytest

from farm.run.worker_settings import HARD_LIMIT_S, DeviceChoice, RendererSettings, WorkerSettings

SETTINGS = WorkerSettings(
    store="s3://bucket/datasets",
    name="bench",
    logs=Path("/var/log/farm"),
    renderer=RendererSettings(device=DeviceChoice.OPTIX, threads=3, assets=Path("/srv/surfaces")),
    concurrency=2,
    tasks_per_child=7,
    memory_per_child_kib=2**20,
    time_limit_s=90.5,
    min_free_mib=0,
)


def test_an_argument_gives_back_the_settings() -> None:
    """All of them, with their types."""
    assert WorkerSettings.from_argument(SETTINGS.as_argument()) == SETTINGS


def test_a_path_that_is_no_utf_8_crosses() -> None:
    """Such folders exist on disks that were written elsewhere; the argument itself is ASCII."""
    odd = os.fsdecode(b"/data/\xe9t\xe9")
    settings = SETTINGS.model_copy(update={"store": odd, "logs": Path(odd)})
    argument = settings.as_argument()
    assert argument.isascii()
    assert WorkerSettings.from_argument(argument) == settings


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"renderer": {"threads": -1}}, r"renderer\.threads: .*greater than or equal to 0"),
        ({"renderer": {"device": "abacus"}}, r"renderer\.device: .*'optix'"),
        ({"concurrency": 0}, "concurrency: "),
        ({"tasks_per_child": 0}, "tasks_per_child: "),
        ({"memory_per_child_kib": 0}, "memory_per_child_kib: "),
        ({"time_limit_s": 0}, "time_limit_s: "),
        ({"time_limit_s": HARD_LIMIT_S + 1}, "time_limit_s: "),
        ({"min_free_mib": -1}, "min_free_mib: "),
        ({"name": ""}, "name: "),
        ({"colour": "red"}, "colour: Extra inputs"),
    ],
)
def test_a_setting_that_makes_no_sense_is_refused(change: dict[str, object], told: str) -> None:
    """In one line that names it."""
    data = json.loads(SETTINGS.as_argument()) | change
    with pytest.raises(ValueError, match=told) as refused:
        WorkerSettings.from_argument(json.dumps(data))
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("text", ["", "{", "[]", "7"])
def test_an_argument_that_holds_no_settings_is_refused(text: str) -> None:
    """Whatever it is."""
    with pytest.raises(ValueError, match=r"\S"):
        WorkerSettings.from_argument(text)
