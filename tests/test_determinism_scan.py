"""No clock, uuid or global generator decides anything in a picture: modules that make pictures don't even name one."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
MAKE_NO_PICTURE = ("worker/service/", "worker/cli.py", "worker/__main__.py", "assets/fetch/")
"""Modules that handle jobs, results and downloads; they may look at the clock."""
FILES = [
    file
    for top in ("worker", "blend", "assets")
    for file in sorted((ROOT / top).rglob("*.py"))
    if not file.relative_to(ROOT).as_posix().startswith(MAKE_NO_PICTURE)
]
FORBIDDEN = ("time.time", "time.time_ns", "datetime.", "uuid.", "random.", "numpy.random.")
SEEDED = ("numpy.random.Generator", "numpy.random.SeedSequence", "numpy.random.PCG64", "numpy.random.default_rng")


def dotted(node: ast.expr, names: dict[str, str]) -> str:
    """The full name of an expression such as `np.random.rand`; empty if it isn't a name."""
    if isinstance(node, ast.Name):
        return names.get(node.id, "")
    if isinstance(node, ast.Attribute) and (base := dotted(node.value, names)):
        return f"{base}.{node.attr}"
    return ""


def offences(source: str) -> Iterator[str]:
    """Every use of something that differs from run to run."""
    tree = ast.parse(source)
    names: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                top = alias.name.partition(".")[0]
                names[alias.asname or top] = alias.name if alias.asname else top
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names |= {alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names}
    for node in ast.walk(tree):
        if not isinstance(node, ast.expr):
            continue
        name = dotted(node, names)
        if name.startswith(FORBIDDEN) and not name.startswith(SEEDED):
            yield f"line {node.lineno}: {name}"
        # A generator without a seed takes one from the system.
        if isinstance(node, ast.Call) and not node.args and not node.keywords:
            called = dotted(node.func, names)
            if called in {"numpy.random.default_rng", "numpy.random.SeedSequence", "numpy.random.PCG64"}:
                yield f"line {node.lineno}: {called}() without a seed"


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_nothing_differs_from_run_to_run(file: Path) -> None:
    """The file uses no clock, uuid or global generator."""
    assert list(offences(file.read_text())) == []


@pytest.mark.parametrize(
    "source",
    [
        "import time\ntime.time()",
        "from time import time\ntime()",
        "import datetime\ndatetime.datetime.now()",
        "from datetime import datetime as d\nd.now()",
        "import uuid\nuuid.uuid4()",
        "import random\nrandom.random()",
        "from random import shuffle\nshuffle([])",
        "import numpy as np\nnp.random.rand()",
        "from numpy import random\nrandom.seed(1)",
        "import numpy as np\nnp.random.default_rng()",
    ],
)
def test_scan_finds(source: str) -> None:
    """The scan finds each offence, under every name."""
    assert list(offences(source))


@pytest.mark.parametrize(
    "source",
    [
        "import time\ntime.perf_counter()",
        "import numpy as np\nnp.random.default_rng(7).random()",
        "import numpy as np\ndef f(draw: np.random.Generator): draw.random()",
    ],
)
def test_scan_passes(source: str) -> None:
    """The scan accepts timings and seeded generators."""
    assert list(offences(source)) == []
