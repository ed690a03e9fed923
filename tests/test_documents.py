"""The documents agree with the repository: links, paths, targets, commands and exit codes that they name exist."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import unquote

import pytest
import typer.main
from typer.core import TyperGroup

from farm.cli import app
from farm.errors import FarmError
from farm.spec.parse import describe
from worker.service import watchdog

ROOT = Path(__file__).parents[1]
ROOMS = ("assets", "benchmarks", "blend", "docker", "docs", "examples", "farm", "tests", "worker")
"""Folders of the repository in which documents lie, or whose files documents name."""

DOCUMENTS = sorted([*ROOT.glob("*.md"), *(page for room in ROOMS for page in (ROOT / room).rglob("*.md"))])
SOURCES = [
    file
    for pattern in ("Makefile", "pyproject.toml", "*.py", *(f"{room}/**/*" for room in (*ROOMS, ".ci")))
    for file in sorted(ROOT.glob(pattern))
    if file.suffix in {".py", ".toml", ".yaml", ".sh", ".txt", ".lua"}
    or (file.name in {"Dockerfile", "Makefile", "run"} and file.is_file())
]
"""Files that may name a document."""

MOST_BYTES = 6 * 1024
"""Size limit of README.md and ARCHITECTURE.md, in bytes: both are read in one go."""

MADE_LATER = ("demo/", "results/", "docker/.env")
"""Starts of paths that the repository does not hold: a command or a user makes these files."""

PLACEHOLDER = "NAME"
"""Word in a path for the part that a reader chooses: `worker/label/NAME.py`."""

FILE_ENDINGS = "py|md|toml|json|html|lua|blend|yaml|acl|sh|jpg|png|txt"
BARE_CODES = {0, 2, watchdog.EXIT_CODE}
"""Exit codes of a command that come without an error of the farm: success, wrong usage, a worker that hung."""

_FENCE = re.compile(r"^```.*?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_SPAN = re.compile(r"(`+)(.+?)\1", re.DOTALL)
_LINK = re.compile(r"\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(([^()\s]+)\)")
_PATH = re.compile(r"\.?\w[\w.-]*(?:/[\w.-]+)*/?")


class Code(NamedTuple):
    """What a document sets in the typeface of code.

    Attributes:
        spans: inline code, without its backticks, each on one line.
        lines: lines of fenced blocks, without comments; a continued line is one.
    """

    spans: list[str]
    lines: list[str]


def code_of(text: str) -> Code:
    """The code in a document."""
    blocks = [block.replace("\\\n", " ") for block in _FENCE.findall(text)]
    lines = [re.sub(r"(^|\s)#.*", "", line) for block in blocks for line in block.splitlines()]
    spans = [" ".join(span.split()) for _, span in _SPAN.findall(_FENCE.sub("", text))]
    return Code(spans=spans, lines=lines)


def anchors_of(text: str) -> set[str]:
    """The anchors that a document's headings have on the web: lower case, hyphens for spaces, no other signs."""
    titles = re.findall(r"^#+ (.+)$", _FENCE.sub("", text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def broken_links(document: Path) -> Iterator[str]:
    """Links to files or headings that don't exist."""
    # An image's alternative text or a link's own may be code; its target never is.
    for link in _LINK.findall(_FENCE.sub("", document.read_text())):
        if re.match(r"[a-z]+:", link):
            continue
        name, _, anchor = unquote(link).partition("#")
        target = (document.parent / name).resolve() if name else document
        if not target.exists():
            yield f"{link}: no such file"
        elif anchor and anchor not in anchors_of(target.read_text()):
            yield f"{link}: no such heading"


def made_on(page: str) -> set[str]:
    """The files that a how-to page has its reader make."""
    return {*re.findall(r"`([\w./]+)` \(new\)", page), *re.findall(r"new file `([\w./]+)`", page)}


def missing_paths(document: Path) -> Iterator[str]:
    """Paths in inline code that look like the repository's and lead nowhere, unless the page itself makes the file."""
    names = {file.name for file in SOURCES}
    text = document.read_text()
    made = made_on(text)
    for span in code_of(text).spans:
        for word in span.split():
            if not _PATH.fullmatch(word) or word.startswith(MADE_LATER) or PLACEHOLDER in word or word in made:
                continue
            is_file = re.search(rf"\.(?:{FILE_ENDINGS})$", word) is not None
            if "/" not in word:
                if word.endswith(".py") and word not in names:
                    yield f"{word}: no module has this name"
            elif (word.split("/")[0] in ROOMS or is_file) and not (ROOT / word).exists():
                yield f"{word}: no such file or folder"


def unknown_modules(document: Path) -> Iterator[str]:
    """Modules that `python -m` can't run."""
    code = code_of(document.read_text())
    for name in re.findall(r"python -m ([\w.]+)", "\n".join([*code.spans, *code.lines])):
        module = ROOT / name.replace(".", "/")
        if not module.with_suffix(".py").exists() and not (module / "__main__.py").exists():
            yield f"python -m {name}"


def unknown_targets(document: Path, makefile: str) -> Iterator[str]:
    """Targets that the Makefile lacks."""
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))
    code = code_of(document.read_text())
    for target in re.findall(r"(?:^|[\s;&])make ([a-z][a-z-]*)", "\n".join([*code.spans, *code.lines]), re.MULTILINE):
        if target not in targets:
            yield f"make {target}"


def unknown_commands(document: Path) -> Iterator[str]:
    """Commands and options that the command line lacks."""
    program = typer.main.get_command(app)
    code = code_of(document.read_text())
    for line in [*code.spans, *code.lines]:
        for words in re.findall(r"(?:^|[\s;&|])farm ([a-z][^;&|]*)", line):
            yield from _unknown_in(program, words.split())


def _unknown_in(command: Any, words: list[str]) -> Iterator[str]:
    # Typer brings a Click of its own, whose classes have no public name.
    named = ["farm"]
    while isinstance(command, TyperGroup) and words:
        name, *words = words
        named.append(name)
        if name not in command.commands:
            yield " ".join(named)
            return
        command = command.commands[name]
    known = {"--help", *(name for parameter in command.params for name in (*parameter.opts, *parameter.secondary_opts))}
    for word in words:
        option = word.partition("=")[0]
        if option.startswith("--") and option not in known:
            yield f"{' '.join(named)} {option}"


def codes_of(error: type[FarmError]) -> Iterator[tuple[int, str]]:
    """The exit codes of a tree of errors, each with the class that defines it."""
    if "exit_code" in vars(error):
        yield error.exit_code, error.__name__
    for kind in error.__subclasses__():
        # A test may define errors of its own.
        if kind.__module__ == FarmError.__module__:
            yield from codes_of(kind)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda document: str(document.relative_to(ROOT)))
class TestEachDocument:
    """What holds for every document."""

    def test_links_resolve(self, document: Path) -> None:
        """A relative link leads to a file, and its anchor to a heading in that file."""
        assert list(broken_links(document)) == []

    def test_paths_exist(self, document: Path) -> None:
        """Inline code that looks like a path of the repository is one."""
        assert list(missing_paths(document)) == []

    def test_modules_run(self, document: Path) -> None:
        """`python -m MODULE` names a module of the repository."""
        assert list(unknown_modules(document)) == []

    def test_targets_are_in_the_makefile(self, document: Path) -> None:
        """`make TARGET` names a target."""
        assert list(unknown_targets(document, (ROOT / "Makefile").read_text())) == []

    def test_commands_are_in_the_command_line(self, document: Path) -> None:
        """`farm COMMAND --option` names a command, and an option that it takes."""
        assert list(unknown_commands(document)) == []


@pytest.mark.parametrize("name", ["README.md", "ARCHITECTURE.md"])
def test_front_pages_are_short(name: str) -> None:
    """The two documents that everybody reads keep within their limit."""
    assert (ROOT / name).stat().st_size <= MOST_BYTES


@pytest.mark.parametrize("name", ["README.md", "docs/datasets.md"])
def test_descriptions_are_accepted(name: str, tmp_path: Path) -> None:
    """The farm takes the description that a document shows, with all its keys."""
    blocks = re.findall(r"^```toml\n(.*?)^```$", (ROOT / name).read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) == 1
    file = tmp_path / "spec.toml"
    file.write_text(blocks[0])
    assert describe(file, {}, {}).spec.total == 25_000


def test_exit_codes_are_those_of_the_errors() -> None:
    """The table in docs/operations.md lists every exit code, with the class of `farm.errors` that defines it."""
    rows = re.findall(
        r"^\| (\d+) \| [^|]+ \| (?:`(\w+)` )?\|$", (ROOT / "docs/operations.md").read_text(), re.MULTILINE
    )
    expected = {*codes_of(FarmError), *((code, "") for code in BARE_CODES)}
    assert sorted((int(code), name) for code, name in rows) == sorted(expected)


def test_code_names_documents_that_exist() -> None:
    """Every document that a source file names is in the repository."""
    named = {
        (source.relative_to(ROOT).as_posix(), name)
        for source in SOURCES
        for name in re.findall(r"(?<![\w/.-])(?:[\w-]+/)*[\w-]+\.md\b", source.read_text())
    }
    how_to = ROOT / "docs/how-to"
    absent = {each for each in named if not (ROOT / each[1]).exists() and not (how_to / each[1]).exists()}
    assert absent == set()
