"""The time of imports by library, from the output of `python -X importtime`."""

import re
from collections import defaultdict
from collections.abc import Iterator

OWN = "own modules and Python's"
"""Name for the modules of the farm and of Python itself."""
ROD = "rod solver"
"""Name for the rod solver's modules, which are counted apart: the first compiled function among them starts numba."""

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
    """Seconds that the import of a module took, by library.

    The imports of a library count as the library's own, so a library that another one imports first counts there.

    Args:
        lines: output of the interpreter; lines of other kinds are ignored.
        root: name of the imported module.

    Returns:
        Seconds by library; empty if the module wasn't imported.
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
    """Each module's path, from the outermost import down to it, with its own seconds; the last import comes first."""
    path: list[str] = []
    # The interpreter writes a module after all its imports, so in reverse order a module comes before its imports.
    for line in reversed(lines.splitlines()):
        found = _LINE.match(line)
        if found:
            depth = (len(found["indent"]) - 1) // 2
            path = [*path[:depth], found["module"]]
            yield path, int(found["own_us"]) * 1e-6
