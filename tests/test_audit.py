"""`make audit`: a missing answer never counts as a good one. A program in pip-audit's place gives its answers."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

AUDIT = Path(__file__).parents[1] / ".ci" / "audit.py"
CLEAN = {"name": "a", "version": "1", "vulns": []}
FAULTY = {"name": "b", "version": "2", "vulns": [{"id": "CVE-1", "fix_versions": ["3"]}]}
UNKNOWN = {"name": "c", "skip_reason": "Dependency not found on PyPI and could not be audited: c (1)"}


def audit(folder: Path, answer: str) -> "subprocess.CompletedProcess[str]":
    """Run the audit with this answer of pip-audit, which always exits with 0."""
    (folder / "pip_audit.py").write_text(f"print({answer!r})")
    (folder / "pins.txt").write_text("a==1\n")
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    command = [sys.executable, str(AUDIT), str(folder / "pins.txt")]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


def test_nothing_known_is_code_0(tmp_path: Path) -> None:
    """If every package was looked up and nothing is known, the code is 0."""
    done = audit(tmp_path, json.dumps({"dependencies": [CLEAN]}))
    assert done.returncode == 0
    assert "0 known vulnerabilities, by pypi" in done.stdout


def test_a_vulnerability_is_code_1(tmp_path: Path) -> None:
    """A vulnerability is named with the version that fixes it."""
    done = audit(tmp_path, json.dumps({"dependencies": [CLEAN, FAULTY]}))
    assert done.returncode == 1
    assert "b 2: CVE-1, mended in 3" in done.stdout


@pytest.mark.parametrize(
    "answer", [json.dumps({"dependencies": [CLEAN, UNKNOWN]}), json.dumps({"dependencies": []}), "", "no JSON", "[]"]
)
def test_what_could_not_be_told_is_code_2(tmp_path: Path, answer: str) -> None:
    """If a service doesn't know a package, or doesn't answer at all, the audit says so."""
    done = audit(tmp_path, answer)
    assert done.returncode == 2
    assert "NOT DONE" in done.stderr
    assert "Traceback" not in done.stderr
