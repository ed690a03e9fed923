"""Compiled functions: one decorator, one place for the compiled code.

Compiled code is kept on disk, below a folder named after the sources' contents: numba alone would not notice a change
in a function that another file's function calls. No fast-math: the order of operations is as written, so that results
are the same bits in every process.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar, cast

import numba

from farm.machine import cache_folder

Function = TypeVar("Function", bound=Callable[..., object])


def _fingerprint() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.name.encode() + source.read_bytes())
    return digest.hexdigest()[:16]


numba.config.CACHE_DIR = str(cache_folder() / "compiled" / _fingerprint())


def compiled(function: Function) -> Function:
    """Compile a function on its first call, or load it from disk."""
    return cast("Function", numba.njit(cache=True, error_model="numpy")(function))
