"""Docstrings, comments and messages keep to docs/style.md, as far as a scan can tell."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FILES = [
    file for top in ("farm", "worker", "blend", "assets", "benchmarks") for file in sorted((ROOT / top).rglob("*.py"))
]
STOPPING_WORDS = re.compile(r"\b(anew|likewise|so many|so often|so much as)\b", re.IGNORECASE)
"""Words that make a reader stop, wherever a line has them: in a docstring, a comment, or a message."""
FRAGMENT_OF_A_CONSTANT = re.compile(r"(Of|By|From|To|In|At|On|Likewise|And|Or)\b")
"""First words of a comment on a constant that doesn't say what the number is."""
FRAGMENT_OF_AN_ARGUMENT = re.compile(r"(of|likewise)\b", re.IGNORECASE)
"""First words of a description that can't be read without the argument's name."""
SECTION = re.compile(r"(\w+):$")
ENTRY = re.compile(r" {4}\*{0,2}\w+: (.*)$")


def docstrings(tree: ast.Module) -> Iterator[tuple[ast.Expr, str, bool]]:
    """Each string that stands alone as a statement, its text, and whether it explains a constant or field above it."""
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        # The body of a lambda or of a conditional expression is no list.
        if not isinstance(body, list):
            continue
        for above, item in zip([None, *body], body, strict=False):
            if isinstance(item, ast.Expr) and isinstance(item.value, ast.Constant):
                text = item.value.value
                if isinstance(text, str):
                    yield item, text, isinstance(above, ast.Assign | ast.AnnAssign)


def described_arguments(docstring: str, column: int) -> Iterator[tuple[int, str]]:
    """The line, counted from 0, and the first line of each description under Args and Attributes.

    Args:
        docstring: text between the quotes, as the file has it.
        column: column of the opening quotes, which is the indentation of the section's headings.
    """
    section = ""
    for number, line in enumerate(docstring.split("\n")):
        inner = line.removeprefix(" " * column)
        if heading := SECTION.match(inner):
            section = heading[1]
        elif section in {"Args", "Attributes"} and (entry := ENTRY.match(inner)):
            yield number, entry[1]


def offences(source: str) -> Iterator[str]:
    """Every place that breaks a rule of docs/style.md."""
    for item, text, explains_constant in docstrings(ast.parse(source)):
        if explains_constant and FRAGMENT_OF_A_CONSTANT.match(text):
            yield f"line {item.lineno}: a constant's comment says what the number is: {text.splitlines()[0]}"
        for number, description in described_arguments(text, item.col_offset):
            if FRAGMENT_OF_AN_ARGUMENT.match(description):
                yield f"line {item.lineno + number}: an argument's description is a noun phrase: {description}"
    for number, line in enumerate(source.splitlines(), 1):
        if word := STOPPING_WORDS.search(line):
            yield f"line {number}: write what you mean by {word[0]!r}: {line.strip()}"


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_prose_keeps_to_the_style(file: Path) -> None:
    """The file has no fragment for a constant or an argument, and no word that makes a reader stop."""
    assert list(offences(file.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize("word", ["anew", "likewise", "so many", "so often", "so much as", "Likewise"])
@pytest.mark.parametrize("line", ['"""It tries {} jobs."""', "x = 1  # {} jobs", 'error = f"{{x}}: {} jobs"'])
def test_scan_finds_words(word: str, line: str) -> None:
    """The scan finds each word in docstrings, comments and messages."""
    assert [each[:7] for each in offences("\n" + line.format(word))] == ["line 2:"]


@pytest.mark.parametrize("word", ["Of", "By", "From", "To", "In", "At", "On", "And", "Or"])
@pytest.mark.parametrize("constant", ["WIDTH_M = 2.0", "WIDTH_M: float = 2.0"])
def test_scan_finds_fragments_of_constants(word: str, constant: str) -> None:
    """The scan finds the comment of a constant that begins with such a word."""
    assert [each[:7] for each in offences(f'{constant}\n"""{word} a band\'s outline."""')] == ["line 2:"]


def test_scan_finds_fragments_of_fields() -> None:
    """The scan finds the comment of a class's field as well."""
    source = 'class Band:\n    """A band."""\n\n    width_m: float\n    """Of its outline."""'
    assert [each[:7] for each in offences(source)] == ["line 5:"]


@pytest.mark.parametrize("section", ["Args", "Attributes"])
@pytest.mark.parametrize("name", ["samples", "redis_url", "*parts", "**quotas"])
def test_scan_finds_fragments_of_arguments(section: str, name: str) -> None:
    """The scan finds the description of an argument or attribute that begins with "of", with its line."""
    source = (
        f'def render() -> None:\n    """Render.\n\n    {section}:\n'
        f'        scene: the scene.\n        {name}: of a pixel.\n    """'
    )
    assert [each[:7] for each in offences(source)] == ["line 6:"]


@pytest.mark.parametrize(
    "source",
    [
        'SAMPLES = 64\n"""Minimum samples per pixel before adaptive sampling may stop."""',
        'SAMPLES = 64\n"""Office lamps need this number of samples."""',
        'SAMPLES = 64\n\n\ndef render() -> None:\n    """Of two renderers, the first renders."""',
        '"""Render.\n\nArgs:\n    samples: official\n        samples: of a pixel.\n"""',
        '"""Render.\n\nArgs:\n    x: one.\n\nRaises:\n    OSError: of a disk.\n"""',
        "x = 1  # renewed, so that many jobs run as often",
        "f = (lambda x: x) if True else None",
    ],
)
def test_scan_passes(source: str) -> None:
    """The scan accepts whole sentences, noun phrases, and sections that describe no argument."""
    assert list(offences(source)) == []
