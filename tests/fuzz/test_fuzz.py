"""A short run of the fuzzer's targets with hypothesis instead of coverage, and the findings of long runs."""

import json
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from farm.errors import FarmError
from tests.fuzz.targets import Target, targets

TARGETS = targets()
FOUND = {
    "job message": [
        b'{"a\\nb": 1}',
        b"[" * 5000,
        b'{"a":' * 5000,
        b"1" * 5000,
        b'{"version": NaN}',
        b'{"a": 1, "a": 2}',
    ],
    "job id": [b"far-00001040\n", b"far\n-000000", b"\xff"],
    "description": [
        b"a=" + b"[" * 5000,
        b"images = " + b"9" * 5000,
        b"images = 0x" + b"f" * 5000,
        b"images = 6\ntemplate = 0x" + b"f" * 5000,
        b"a" + b".a" * 5000 + b" = 1",
        b"\xff",
    ],
    "header": [b"[" * 100_000, b"\xff", b"", b"9" * 10_000],
    "manifest": [b"[" * 100_000, b"\xff", b"", b"9" * 10_000],
    "destination": [b"\0", b"~nobody-of-this-name/x", b"~\0", b"s3://", b"://", b"/", b"..", b"a" * 5000],
    "quotas": [b"far=" + b"9" * 5000, "far=\u0663".encode(), b"far=-1", b"=", b"far=1\nfar=1"],
    "quality": [b"1" * 5000, b"nan", b"inf", b"1e999"],
    "broker address": [b"rediss://[", b"rediss://a?ssl_cert_reqs=none", b"redis://\0", b"rediss://a:b@c:d?e#f"],
}


def parse(target: Target, data: bytes) -> None:
    """Parse an input; any error but the farm's own fails the test."""
    with suppress(FarmError):
        target.parse(data)


def mutations(seed: bytes) -> st.SearchStrategy[bytes]:
    """A good input with a piece replaced."""
    place = st.integers(0, len(seed))
    return st.tuples(place, place, st.binary(max_size=16)).map(
        lambda cut: seed[: min(cut[:2])] + cut[2] + seed[max(cut[:2]) :]
    )


@pytest.mark.parametrize("name", TARGETS)
def test_nothing_but_a_farm_error(name: str) -> None:
    """Any bytes, and good inputs with a piece replaced, raise nothing but a FarmError."""
    target = TARGETS[name]
    altered = st.one_of([mutations(seed) for seed in target.seeds])

    @settings(max_examples=60, deadline=None)
    @given(st.binary(max_size=64) | altered)
    def look(data: bytes) -> None:
        parse(target, data)

    look()


@pytest.mark.parametrize(("name", "data"), [(name, data) for name, found in FOUND.items() for data in found])
def test_what_was_found_stays_mended(name: str, data: bytes) -> None:
    """Inputs that raised another error once, or might have, raise none."""
    parse(TARGETS[name], data)


@pytest.mark.parametrize("name", TARGETS)
def test_the_good_inputs_are_good(name: str) -> None:
    """The good inputs are accepted, so that the fuzzer begins with something."""
    for seed in TARGETS[name].seeds:
        if name == "job id" and b"/" in seed:
            continue  # this target calls two parsers, and the input is for the other one
        TARGETS[name].parse(seed)


def test_the_fuzzer_finds_a_defect(tmp_path: Path) -> None:
    """A defect that is put in appears in the table, the file and the exit code; the farm's own errors don't."""
    pytest.importorskip("atheris")
    program = (
        "import tests.fuzz.targets as t\n"
        "def bad(data):\n"
        "    if data[:1] == b'f': raise ZeroDivisionError('a bug')\n"
        "    raise t.FarmError('foreseen')\n"
        "t.targets = lambda: {'bad': t.Target(bad, (b'far',))}\n"
        "import sys\n"
        "from tests.fuzz import one\n"
        "one.targets = t.targets\n"
        "one.main(sys.argv[1:])\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, "bad", str(tmp_path), "-runs=1000", "-seed=1"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = [json.loads(line) for line in (tmp_path / "failures.jsonl").read_text().splitlines()]
    assert [entry["error"] for entry in found] == ["ZeroDivisionError: a bug"]


def test_a_short_run_ends_well(tmp_path: Path) -> None:
    """The whole program over two targets prints a line for each, writes a report, and ends with 0."""
    pytest.importorskip("atheris")
    options = ["--runs", "300", "--seconds", "20", "--target", "job id", "--target", "quotas", "--out", str(tmp_path)]
    done = subprocess.run([sys.executable, "-m", "tests.fuzz", *options], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    report = json.loads((tmp_path / "fuzz.json").read_text())
    assert [(entry["target"], entry["inputs"] > 0, entry["failures"]) for entry in report["targets"]] == [
        ("job id", True, []),
        ("quotas", True, []),
    ]
