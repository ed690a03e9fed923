"""The worker's program as a command starts it: its errors keep their kind."""

import sys
from pathlib import Path

import pytest

from farm.cli import worker_program
from farm.errors import DestinationError, FarmError, PermanentError, RenderError, RetryableError
from farm.run.worker_settings import RendererSettings
from farm.spec.header import DatasetHeader

KINDS = [
    kind
    for kind in (*RetryableError.__subclasses__(), *PermanentError.__subclasses__())
    if kind.exit_code != FarmError.exit_code
]


@pytest.mark.parametrize("kind", KINDS)
def test_worker_program_keeps_its_kind_of_error(
    kind: type[FarmError], header: DatasetHeader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of the farm's errors passes from the worker's program to the command line, with its code and words."""
    program = [sys.executable, "-c", f"import sys; sys.stderr.write('why'); sys.exit({kind.exit_code})"]
    monkeypatch.setattr(worker_program, "WORKER_COMMAND", program)
    with pytest.raises(kind, match="why") as refused:
        worker_program.ask_worker([], header, tmp_path)
    assert type(refused.value) is kind


@pytest.mark.parametrize("command", ["check", "preview"])
def test_worker_program_without_a_place_for_logs(command: str, header: DatasetHeader, tmp_path: Path) -> None:
    """A log folder that can't be made gives one line and no traceback."""
    (tmp_path / "file").write_text("")
    options = ["--job", "far-000000", "--out", "x.png"] if command == "preview" else []
    with pytest.raises(DestinationError, match=r"^\S*file/logs: can't write logs[^\n]*$"):
        worker_program.ask_worker([command, *options], header, tmp_path / "file/logs")


def test_success_is_told_when_the_files_are_there(
    header: DatasetHeader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program that ends well without a picture, or leaves the picture of an earlier time, has failed."""
    monkeypatch.setattr(worker_program, "WORKER_COMMAND", [sys.executable, "-c", "pass"])
    job = next(iter(header.spec.jobs()))
    files = worker_program.PictureFiles.in_folder(tmp_path, job)
    for content in (None, b"of an earlier time"):
        if content is not None:
            files.picture.write_bytes(content)
        with pytest.raises(RenderError, match=f"{files.picture}.*wrote no picture"):
            worker_program.make_picture(header, job, files, RendererSettings(), tmp_path)
