"""The commands of the worker's program."""

from pathlib import Path

import pytest

from farm.run.worker_settings import WorkerSettings
from tests.stand_in import open_stand_in
from worker.cli import main

WRONG_USAGE = 2


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["serve", '{"store": "data"}'], "argument settings: name: Field required"),
        (["serve"], "the following arguments are required: settings"),
        (
            ["device", "--logs", "logs", "--renderer", '{"threads": -1}'],
            "argument --renderer: threads: Input should be",
        ),
    ],
)
def test_wrong_settings_end_with_one_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    told: str,
) -> None:
    """Before anything is made, with the exit code of wrong usage."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(arguments, open_stand_in)
    assert ended.value.code == WRONG_USAGE
    assert told in capsys.readouterr().err.splitlines()[-1]
    assert list(tmp_path.iterdir()) == []


def test_settings_hold_no_address_of_a_redis() -> None:
    """Arguments are public, and the address may hold a password."""
    assert not [name for name in WorkerSettings.model_fields if "broker" in name or "url" in name]
