"""What imports are due to, from what `python -X importtime` writes."""

import re
from collections import defaultdict
from collections.abc import Iterator

OWN = "own modules and Python's"
ROD = "rod solver"
"""Its modules' own seconds: numba is made ready by the first of its compiled functions."""

_LIBRARIES = {
    "bpy": "Blender",
    "celery": "Celery",
    "kombu": "Celery",
    "redis": "Redis client",
    "pydantic": "pydantic",
    "pydantic_core": "pydantic",
    "numpy": "NumPy",
    "cv2": "OpenCV",
    "numba": "numba",
    "scipy": "SciPy",
}

_LINE = re.compile(r"import time:\s*(?P<own_us>\d+) \|\s*\d+ \|(?P<indent> +)(?P<module>\S+)$")


def seconds_by_library(lines: str, root: str) -> dict[str, float]:
    """Seconds that importing a module took, by the library that asked for them.

    What a library imports itself counts as its own, so one that is imported earlier by another counts there.

    Args:
        lines: what the interpreter wrote; lines of other kinds are passed over.
        root: the imported module.

    Returns:
        Library to seconds; empty if the module was not imported.
    """
    seconds: dict[str, float] = defaultdict(float)
    for path, own_s in _modules(lines):
        if root in path:
            below = path[path.index(root) :]
            seconds[_library(below)] += own_s
    return dict(seconds)


def _library(path: list[str]) -> str:
    libraries = (_LIBRARIES.get(module.partition(".")[0]) for module in path)
    own = ROD if path[-1].startswith("worker.simulate.rod") else OWN
    return next(filter(None, libraries), own)


def _modules(lines: str) -> Iterator[tuple[list[str], float]]:
    """Each module's path from the outermost import down to it, with its own seconds; the last comes first."""
    path: list[str] = []
    # A module is written after all that it imports, so from the end each comes before what is below it.
    for line in reversed(lines.splitlines()):
        found = _LINE.match(line)
        if found:
            depth = (len(found["indent"]) - 1) // 2
            path = [*path[:depth], found["module"]]
            yield path, int(found["own_us"]) * 1e-6
