"""The command line: exit codes, one clear line, and nothing left behind by a refused command."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
import redis

from farm.category import Category
from farm.cli import main, worker_program
from farm.collect import write_index
from farm.dataset import Dataset
from farm.errors import (
    AssetError,
    BrokerError,
    ConflictError,
    DestinationError,
    EnvironmentMissingError,
    FarmError,
    IncompleteError,
    PermanentError,
    RetryableError,
    SpecError,
    TemplateError,
    VerificationError,
)
from farm.header import DatasetHeader
from farm.layout import INDEX_FILE, REPORT_FILE
from farm.ledger.redis import RedisLedger
from tests.stand_in import StandInMaker
from worker.upload import upload

submit_command = sys.modules["farm.cli.submit"]  # the package's own `submit` is the command
USAGE = 2
NO_REDIS = "redis://127.0.0.1:1/0"


@dataclass(frozen=True)
class Result:
    """How a command ended."""

    returncode: int
    stdout: str
    stderr: str


Farm = Callable[..., Result]


@pytest.fixture
def farm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Farm:
    """Runs a command in a folder of its own, in this process, which saves a start for each."""
    monkeypatch.chdir(tmp_path)
    for name in ("FARM_BROKER_URL", "FARM_STORE", "FARM_ASSETS", "FARM_LOGS"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(signal, "signal", lambda *_: None)

    def run(*arguments: str) -> Result:
        capsys.readouterr()  # what fixtures printed
        monkeypatch.setattr(sys, "argv", ["farm", *arguments])
        with pytest.raises(SystemExit) as ended:
            main()
        printed = capsys.readouterr()
        return Result(int(ended.value.code or 0), printed.out, printed.err)

    return run


def assert_refused(result: Result, code: int, *words: str) -> None:
    """The command ended with this code, in one line on standard error that has these words."""
    assert result.returncode == code, result.stderr
    lines = result.stderr.strip().splitlines()
    assert len(lines) == 1, result.stderr
    for word in words:
        assert word in lines[0]


def write_toml(folder: Path, text: str) -> str:
    """A description in a file."""
    (folder / "cables.toml").write_text(text)
    return "cables.toml"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--quota", "near=3"], ["near", "unknown category", "far_aligned"]),
        (["--quota", "far=-3"], ["far=-3", "whole number"]),
        (["--quota", "far=1.5"], ["far=1.5", "whole number"]),
        (["--quota", "far"], ["CATEGORY=NUMBER"]),
        (["--quota", "far=1", "--quota", "far=2"], ["far", "already"]),
        (["--quota", "far=0"], ["zero images"]),
        (["--images", "0"], ["zero images"]),
        (["--images", "-5"], ["images", "-5"]),
        (["--images", "5", "--quota", "far=1"], ["--images", "--quota"]),
        ([], ["number of images"]),
        (["--images", "1", "--seed", "-1"], ["seed"]),
        (["--images", "1", "--resolution", "3"], ["resolution"]),
        (["--images", "1", "--close-distributed-hdri", "moon"], ["moon", "there is no HDRI"]),
    ],
)
@pytest.mark.parametrize("command", ["run", "submit"])
def test_bad_flags(farm: Farm, tmp_path: Path, command: str, options: list[str], words: list[str]) -> None:
    """A description that makes no sense is refused with the flag and what was wrong with it."""
    assert_refused(farm(command, *options, "--out", "data"), SpecError.exit_code, *words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "options",
    [
        ["--images", "many"],
        ["--engine", "pencil", "--images", "1"],
        ["--device", "abacus", "--images", "1"],
        ["--what"],
    ],
)
def test_bad_usage(farm: Farm, tmp_path: Path, options: list[str]) -> None:
    """A flag of the wrong type, or that does not exist, is wrong usage."""
    assert farm("run", *options, "--out", "data").returncode == USAGE
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("images = ", ["cables.toml", "not valid TOML"]),
        ("images = 3\ncolour = 1", ["cables.toml", "colour", "unknown key"]),
        ("images = 3\n[ranges.cable]\nlenght_m = 1.0", ["ranges.cable.lenght_m", "unknown key"]),
        ("images = 3\n[ranges.cable]\ncount = [5, 2]", ["ranges.cable.count", "above"]),
        ("images = 3\ntextures = 'wood'", ["textures", "list of paths"]),
        ("images = 3\ntemplate = 3", ["template", "path"]),
        ("images = '3'", ["images"]),
        ("[quotas]\nnear = 3", ["near", "unknown category"]),
        ("[quotas]\nfar = 1.5", ["quotas.far"]),
        ("images = 3\nversion = 2", ["version"]),
    ],
)
def test_bad_file(farm: Farm, tmp_path: Path, text: str, words: list[str]) -> None:
    """A wrong file is refused with its name, the key and what was wrong with it."""
    file = write_toml(tmp_path, text)
    assert_refused(farm("run", file, "--out", "data"), SpecError.exit_code, *words)
    assert [path.name for path in tmp_path.iterdir()] == ["cables.toml"]


def test_no_file(farm: Farm) -> None:
    """A description that is not there is named."""
    assert_refused(farm("run", "none.toml", "--out", "data"), SpecError.exit_code, "none.toml")


@pytest.mark.parametrize(
    ("content", "words"), [(None, ["No such file"]), (b"", [".blend"]), (b"<html>", ["not a .blend file"])]
)
def test_bad_template(farm: Farm, tmp_path: Path, content: bytes | None, words: list[str]) -> None:
    """A template that is not there, or is no .blend file, is refused by its name."""
    inputs = tmp_path / "inputs"
    inputs.mkdir()
    if content is not None:
        (inputs / "mine.blend").write_bytes(content)
    result = farm("run", "--images", "1", "--template", "inputs/mine.blend", "--out", "data")
    assert_refused(result, TemplateError.exit_code, "mine.blend", *words)
    assert [path.name for path in tmp_path.iterdir()] == ["inputs"]


@pytest.mark.parametrize(
    ("flag", "name", "content"),
    [
        ("--textures", "wood_color.png", b"no image"),
        ("--textures", None, b""),
        ("--hdris", "sky.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n\x02\x02"),
        ("--hdris", "sky.exr", b"\x76\x2f\x31\x01"),
        ("--hdris", None, b""),
    ],
)
def test_bad_assets(farm: Farm, tmp_path: Path, flag: str, name: str | None, content: bytes) -> None:
    """A texture that is no image, a truncated HDRI and an empty folder are refused by their names."""
    inputs = tmp_path / "inputs"
    inputs.mkdir()
    if name is not None:
        (inputs / name).write_bytes(content)
    result = farm("submit", "--images", "1", flag, "inputs", "--out", "data")
    assert_refused(result, AssetError.exit_code, name or "inputs")
    assert [path.name for path in tmp_path.iterdir()] == ["inputs"]


def test_no_assets_left(farm: Farm) -> None:
    """Leaving the built-in surfaces out without naming others is refused."""
    result = farm("submit", "--images", "1", "--no-builtin-textures", "--out", "data")
    assert_refused(result, AssetError.exit_code, "--textures")


@pytest.mark.parametrize("command", ["submit", "worker", "flower"])
def test_no_redis(farm: Farm, tmp_path: Path, command: str) -> None:
    """A Redis that is not there is named, with what to do, before anything is written."""
    options = {"submit": ["--images", "1", "--out", "data"], "worker": ["--store", "."], "flower": []}[command]
    result = farm(command, *options, "--broker", NO_REDIS)
    assert_refused(result, BrokerError.exit_code, "127.0.0.1:1", "--broker")
    assert list(tmp_path.iterdir()) == []


def test_password_is_not_shown(farm: Farm) -> None:
    """An address is told without its password."""
    result = farm("submit", "--images", "1", "--out", "data", "--broker", "redis://:hush@127.0.0.1:1/0")
    assert_refused(result, BrokerError.exit_code, "redis://***@127.0.0.1:1")
    assert "hush" not in result.stderr


def test_broker_that_is_no_redis(farm: Farm) -> None:
    """Another kind of broker is refused."""
    result = farm("submit", "--images", "1", "--out", "data", "--broker", "amqp://localhost")
    assert_refused(result, BrokerError.exit_code, "amqp://localhost", "redis://")


@pytest.mark.redis
@pytest.mark.parametrize("command", ["run", "submit"])
def test_destination_that_cannot_be_written(
    farm: Farm, tmp_path: Path, redis_url: str, redis_client: "redis.Redis", command: str
) -> None:
    """A place below a file can't be written, which is told before anything is queued."""
    (tmp_path / "file").write_text("")
    broker = ["--broker", redis_url] if command == "submit" else []
    result = farm(command, "--quota", "far=1", "--out", "file/data", *broker)
    assert_refused(result, DestinationError.exit_code, "file/data")
    assert redis_client.keys() == []


@pytest.mark.parametrize("command", ["run", "submit"])
def test_place_of_another_dataset(farm: Farm, redis_url: str, dataset: Dataset, command: str) -> None:
    """A place that holds another dataset is refused with the first difference, and stays as it is."""
    before = dataset.storage.files()
    broker = ["--broker", redis_url] if command == "submit" else []
    result = farm(command, "--quota", "far=1", "--out", dataset.storage.location, *broker)
    assert_refused(result, ConflictError.exit_code, "holds another dataset", "spec.quotas", "another --out")
    assert dataset.storage.files() == before


@pytest.mark.blender
@pytest.mark.redis
@pytest.mark.skipif(any(Path("/dev").glob("kfd")), reason="needs a machine without an AMD GPU")
@pytest.mark.parametrize("command", ["run", "worker"])
def test_device_that_is_not_there(farm: Farm, tmp_path: Path, redis_url: str, command: str) -> None:
    """A device that this machine lacks is refused before surfaces are drawn or a job is taken."""
    options = {"run": ["--images", "1", "--out", "data"], "worker": ["--store", ".", "--broker", redis_url]}[command]
    result = farm(command, *options, "--device", "hip", "--logs", "logs")
    assert_refused(result, EnvironmentMissingError.exit_code, "--device hip")
    assert not (tmp_path / "data").exists()
    assert list(tmp_path.rglob("*.png")) == []


@pytest.mark.redis
def test_worker_whose_store_is_a_file(farm: Farm, tmp_path: Path, redis_url: str) -> None:
    """A store that can't be read is refused before a job is taken."""
    (tmp_path / "file").write_text("")
    assert_refused(farm("worker", "--store", "file", "--broker", redis_url), DestinationError.exit_code, "file")


@pytest.mark.parametrize("command", ["status", "verify", "report"])
def test_no_dataset(farm: Farm, tmp_path: Path, command: str) -> None:
    """Commands on a dataset say when there is none."""
    assert_refused(farm(command, "data"), DestinationError.exit_code, "no dataset here")
    assert list(tmp_path.iterdir()) == []


def test_name_that_is_none(farm: Farm) -> None:
    """A place whose last part can't name a dataset is refused."""
    assert_refused(farm("run", "--images", "1", "--out", ".data"), DestinationError.exit_code, ".data")


@pytest.mark.redis
def test_submit_queues_once(farm: Farm, redis_url: str, redis_client: object) -> None:
    """A submission is queued; repeated, nothing is added; described otherwise, it is refused."""
    del redis_client  # empties the queue
    options = ["--out", "data", "--broker", redis_url]
    first = farm("submit", "--images", "12", *options)
    assert first.stdout.startswith("12 of 12 images queued"), first.stderr
    again = farm("submit", "--images", "12", *options)
    assert again.stdout.startswith("0 of 12 images queued")
    other = farm("submit", "--images", "12", "--seed", "5", *options)
    assert_refused(other, ConflictError.exit_code, "spec.seed is 0, asked 5", "another --out")


def test_file_and_flags(farm: Farm, tmp_path: Path) -> None:
    """A flag overrides the file's key, and a quota the file's total."""
    file = write_toml(tmp_path, "images = 12\nseed = 3\n")
    result = farm("submit", file, "--quota", "far=0", "--out", "data")
    assert_refused(result, SpecError.exit_code, "cables.toml and flags", "zero images")


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInMaker().make(job, dataset.header), job, dataset)
    return dataset


def test_status(farm: Farm, made: Dataset) -> None:
    """Without Redis the folder alone tells how far a dataset is."""
    result = farm("status", made.storage.location, "--json")
    progress = json.loads(result.stdout)
    assert progress["categories"]["far"] == {"done": 2, "quota": 2}
    assert progress["running"] is None
    assert "all" in farm("status", made.storage.location).stdout


def test_verify_clean(farm: Farm, made: Dataset) -> None:
    """A finished dataset passes, with its index and report in it."""
    write_index(made)
    assert farm("report", made.storage.location).returncode == 0
    result = farm("verify", made.storage.location)
    assert result.returncode == 0, result.stderr
    assert "4 images" in result.stdout


def test_verify_finds(farm: Farm, made: Dataset) -> None:
    """A missing and an extra file are listed, and the exit code tells."""
    made.storage.remove("far/masks/far-000001.png")
    made.storage.write("far/stray.txt", b"")
    result = farm("verify", made.storage.location)
    assert result.returncode == VerificationError.exit_code
    assert "1 extra, 1 missing" in result.stderr
    assert "missing: far/masks/far-000001.png" in result.stderr
    as_json = farm("verify", made.storage.location, "--json")
    assert as_json.returncode == VerificationError.exit_code
    assert {finding["path"] for finding in json.loads(as_json.stdout)["findings"]} == {
        "far/masks/far-000001.png",
        "far/stray.txt",
    }


@pytest.mark.redis
def test_status_names_the_last_picture(farm: Farm, made: Dataset, redis_url: str, redis_client: "redis.Redis") -> None:
    """Of a finished dataset, too, the newest picture is told by a path that can be opened from anywhere."""
    ledger = RedisLedger(redis_client, made.name, made.header.spec_sha256)
    ledger.record_done("far-000001", "far/images/far-000001.png")
    result = farm("status", made.storage.location, "--broker", redis_url)
    line = next(line for line in result.stdout.splitlines() if line.startswith("last "))
    assert Path(line.split()[1]).is_absolute()
    assert Path(line.split()[1]).is_file()


@pytest.mark.redis
def test_watch_and_submit_leave_index_and_report(
    farm: Farm, made: Dataset, redis_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whoever waits for the end of a dataset finds its index and page, as after `farm run`."""
    monkeypatch.setattr(submit_command, "make_header", lambda *_: made.header)
    commands = [("watch", made.storage.location), ("submit", "--images", "1", "--out", made.storage.location, "--wait")]
    for arguments in commands:
        result = farm(*arguments, "--broker", redis_url)
        assert result.returncode == 0, result.stderr
        for name in (INDEX_FILE, REPORT_FILE):
            assert made.storage.read(name)
            made.storage.remove(name)


@pytest.mark.redis
def test_watch_of_a_failure_leaves_index_and_report(
    farm: Farm, made: Dataset, redis_url: str, redis_client: "redis.Redis"
) -> None:
    """What could be made is listed though the rest failed."""
    made.storage.remove("far/manifests/far-000001.json")
    RedisLedger(redis_client, made.name, made.header.spec_sha256).record_failure("far-000001", "no scene passed")
    result = farm("watch", made.storage.location, "--broker", redis_url)
    assert result.returncode == IncompleteError.exit_code
    assert len(made.storage.read(INDEX_FILE).splitlines()) == 3
    assert made.storage.read(REPORT_FILE)


@pytest.mark.redis
def test_watch_ends_with_the_dataset(farm: Farm, made: Dataset, redis_url: str) -> None:
    """Watching a finished dataset ends at once."""
    result = farm("watch", made.storage.location, "--broker", redis_url)
    assert result.returncode == 0
    assert "4 of 4 done" in result.stderr


@pytest.mark.parametrize("out", ["picture.jpg", "nowhere/picture.png"])
def test_preview_that_cannot_be_written(farm: Farm, tmp_path: Path, out: str) -> None:
    """A picture of another kind, or in a folder that is not there, is refused before it is made."""
    result = farm("preview", "--category", "far", "--out", out)
    assert_refused(result, DestinationError.exit_code, out)
    assert list(tmp_path.iterdir()) == []


def test_preview_over_a_folder(farm: Farm, tmp_path: Path) -> None:
    """A picture or mask that would replace a folder is refused before it is made."""
    (tmp_path / "preview-mask.png").mkdir()
    result = farm("preview", "--category", "far")
    assert_refused(result, DestinationError.exit_code, "preview-mask.png", "is a folder")


def test_preview_in_a_folder_without_rights(farm: Farm, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that can't be written is refused before the picture is made."""
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert_refused(farm("preview", "--category", "far"), DestinationError.exit_code, "can't be written")


KINDS = [
    kind
    for kind in (*RetryableError.__subclasses__(), *PermanentError.__subclasses__())
    if kind.exit_code != FarmError.exit_code
]


@pytest.mark.parametrize("kind", KINDS)
def test_worker_program_keeps_its_kind_of_error(
    kind: type[FarmError], header: DatasetHeader, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of the farm's errors crosses from the worker's program to the command line, with its code and words."""
    program = [sys.executable, "-c", f"import sys; sys.stderr.write('why'); sys.exit({kind.exit_code})"]
    monkeypatch.setattr(worker_program, "WORKER_COMMAND", program)
    with pytest.raises(kind, match="why") as refused:
        worker_program.ask_worker([], header, tmp_path)
    assert type(refused.value) is kind


@pytest.mark.parametrize("command", ["check", "preview"])
def test_worker_program_without_a_place_for_logs(command: str, header: DatasetHeader, tmp_path: Path) -> None:
    """A log folder that can't be made is one clear line, not a traceback."""
    (tmp_path / "file").write_text("")
    options = ["--job", "far-000000", "--out", "x.png"] if command == "preview" else []
    with pytest.raises(DestinationError, match=r"^\S*file/logs: can't write logs[^\n]*$"):
        worker_program.ask_worker([command, *options], header, tmp_path / "file/logs")


def test_assets_to_check(farm: Farm) -> None:
    """Without a folder there is nothing to check."""
    assert_refused(farm("assets", "check"), SpecError.exit_code, "--textures DIR")


def test_assets_are_listed(farm: Farm) -> None:
    """The list has surfaces and HDRIs, and tells which are drawn."""
    result = farm("assets", "list")
    assert result.returncode == 0
    assert "not yet" in result.stdout
    assert "CC0" in result.stdout


def test_preview_takes_no_quota(farm: Farm) -> None:
    """A preview is one image."""
    result = farm("preview", "--category", "far", "--images", "3")
    assert_refused(result, SpecError.exit_code, "--images")


def test_preview_of_an_unknown_category(farm: Farm) -> None:
    """An unknown category is wrong usage, and the known ones are listed."""
    result = farm("preview", "--category", "near")
    assert result.returncode == USAGE
    assert Category.FAR in result.stderr


def test_entry_point(tmp_path: Path) -> None:
    """The installed program ends as its commands do."""
    program = [str(Path(sys.executable).with_name("farm")), "status", "data"]
    result = subprocess.run(program, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode == DestinationError.exit_code
    assert result.stderr.startswith("farm: ")
