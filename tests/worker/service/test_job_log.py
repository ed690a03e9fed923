"""The output of a job."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import worker.service.job_log
from farm.dataset.dataset import Dataset
from farm.errors import DestinationError
from farm.spec.job import Job, JobMessage
from worker.service.job_log import MAX_BYTES, JobLogs


@pytest.fixture
def message(dataset: Dataset) -> JobMessage:
    """A message that asks for one job."""
    return dataset.message(Job.from_id("far-000001"))


@pytest.fixture
def logs(tmp_path: Path) -> JobLogs:
    """Logs in a folder that doesn't exist yet."""
    return JobLogs(tmp_path / "logs/jobs")


PROGRAM = """
import os, pathlib, sys
from farm.spec.job import JobMessage
from worker.service.job_log import JobLogs

logs = JobLogs(pathlib.Path(sys.argv[1]))
message = JobMessage.model_validate_json(sys.argv[2])
print("before")
try:
    with logs.taking(message):
        print("from Python", flush=True)
        os.write(1, b"from C\\n")
        os.write(2, b"an error from C\\n")
        print("left in a buffer")
        raise ZeroDivisionError
except ZeroDivisionError:
    print("after")
"""


def test_takes_all_levels(tmp_path: Path, logs: JobLogs, message: JobMessage) -> None:
    """Output of Python and of C code goes to the log, even if the job fails, and later output where it did before."""
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path / "logs/jobs"), message.model_dump_json()],
        capture_output=True,
        text=True,
        check=True,
    )
    assert logs.path(message).read_text() == "from Python\nfrom C\nan error from C\nleft in a buffer\n"
    assert ended.stdout == "before\nafter\n"
    assert ended.stderr == ""


def test_descriptors_are_not_used_up(logs: JobLogs, message: JobMessage) -> None:
    """Over many jobs no descriptor stays open."""
    before = len(list(Path("/proc/self/fd").iterdir()))
    for _ in range(20):
        with logs.taking(message):
            pass
    assert len(list(Path("/proc/self/fd").iterdir())) == before


def test_each_attempt_has_its_own(logs: JobLogs, message: JobMessage) -> None:
    """The log of a job is that of its last attempt."""
    for word in (b"first", b"second"):
        with logs.taking(message):
            os.write(1, word)
    assert logs.tail(message) == "second"


def test_size_is_bounded(logs: JobLogs, message: JobMessage) -> None:
    """The end of a long log is kept."""
    with logs.taking(message):
        for _ in range(5):
            os.write(1, b"x" * MAX_BYTES)
        os.write(1, b"the end")
    content = logs.path(message).read_bytes()
    assert len(content) == MAX_BYTES
    assert content.endswith(b"xthe end")


def test_number_is_bounded(logs: JobLogs, dataset: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    """The newest logs are kept, and some more until room is made."""
    monkeypatch.setattr(worker.service.job_log, "MAX_FILES", 5)
    monkeypatch.setattr(worker.service.job_log, "_ROOM_EVERY", 3)
    paths = []
    for index in range(30):
        message = dataset.message(Job.from_id(f"far-{index:06d}"))
        with logs.taking(message):
            pass
        paths.append(logs.path(message))
        os.utime(paths[-1], (index, index))
        assert len(list(paths[0].parent.iterdir())) <= 5 + 3
    assert all(path.exists() for path in paths[-5:])
    assert not any(path.exists() for path in paths[:20])


def test_tail(logs: JobLogs, message: JobMessage) -> None:
    """The tail is the last sixteen KiB of a log, with invalid text replaced."""
    with logs.taking(message):
        os.write(1, b"a" * 20_000 + b"\xff\n")
    tail = logs.tail(message)
    assert len(tail) == 16 * 1024
    assert tail.endswith("a\ufffd\n")


def test_no_log(logs: JobLogs, message: JobMessage) -> None:
    """A job that didn't run here has no tail."""
    assert logs.tail(message) == ""


def test_datasets_are_apart(logs: JobLogs, message: JobMessage) -> None:
    """Logs of two descriptions under one name are apart, and all lie in the folder."""
    other = message.model_copy(update={"spec_sha256": "f" * 64})
    assert logs.path(message) != logs.path(other)
    assert logs.path(message).parent.parent == logs.path(other).parent.parent


def test_folder_that_cannot_be_written(tmp_path: Path, message: JobMessage) -> None:
    """If no log can be written, the job isn't begun."""
    (tmp_path / "file").write_text("")
    with pytest.raises(DestinationError, match="can't write logs"), JobLogs(tmp_path / "file").taking(message):
        pytest.fail("begun")
