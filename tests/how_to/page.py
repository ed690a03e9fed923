"""A page of docs/how-to as the steps that it tells, and a copy of the tree in which they are followed.

A page tells a step by a line with a file's name in backquotes and a colon, and the block of code below it. A block of
Python is the content of a new file, where the line says so, or else a program to run. A block of `diff` changes a file:
each part after an `@@` is found in the file by its lines that stay or go, and must be there once.
"""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = ROOT / "docs" / "how-to"

_COPIED = ("assets", "benchmarks", "blend", "farm", "tests", "worker", "pyproject.toml")

_STEP = re.compile(r"^`(?P<file>[^`\n]+)`(?P<new> \(new\))?:\n\n```(?P<kind>\w+)\n(?P<block>.*?)^```$", re.M | re.S)

SCRIPT = "scripted"
"""Stands where a file's name would, before a program to run."""


@dataclass(frozen=True, slots=True)
class Step:
    """What a page tells to do.

    Attributes:
        file: the file to change or make, from the tree's root; `SCRIPT` for a program to run.
        is_new: whether the file is made.
        block: the file's content, the changes, or the program.
    """

    file: str
    is_new: bool
    block: str


def steps_of(page: str, heading: str = "") -> list[Step]:
    """The steps of a page, or of those below one of its headings of the second level."""
    text = (PAGES / page).read_text()
    if heading:
        text = text.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    return [Step(found["file"], bool(found["new"]), found["block"]) for found in _STEP.finditer(text)]


class Tree:
    """A copy of the farm's sources."""

    def __init__(self, folder: Path) -> None:
        """Copy them into a folder, which is made."""
        folder.mkdir()
        self.folder = folder
        for name in _COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, folder / name)

    def follow(self, steps: list[Step]) -> None:
        """Make and change the files that the steps tell of, and run their programs."""
        for step in steps:
            path = self.folder / step.file
            if step.file == SCRIPT:
                self.python(step.block)
            elif step.is_new:
                assert not path.exists(), f"{step.file} is there already"
                path.parent.mkdir(exist_ok=True)
                path.write_text(step.block)
            else:
                path.write_text(_changed(path.read_text(), step))

    def python(self, program: str, *arguments: str) -> str:
        """What a program prints that runs in the tree."""
        return self._run("-c", program, *arguments)

    def pytest(self, *arguments: str) -> str:
        """What pytest prints, in the tree; all tests that it runs must pass, and there must be some."""
        return self._run("-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments)

    def _run(self, *arguments: str) -> str:
        environment = {**os.environ, "PYTHONPATH": str(self.folder), "PYTHONDONTWRITEBYTECODE": "1"}
        done = subprocess.run(
            [sys.executable, *arguments],
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


def _changed(content: str, step: Step) -> str:
    for part in step.block.split("@@\n")[1:]:
        lines = part.splitlines(keepends=True)
        before = "".join(line[1:] for line in lines if not line.startswith("+"))
        after = "".join(line[1:] for line in lines if not line.startswith("-"))
        assert content.count(before) == 1, f"{step.file} holds this {content.count(before)} times:\n{before}"
        content = content.replace(before, after)
    return content
