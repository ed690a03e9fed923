"""Lua scripts that Redis runs whole, each in a file beside the module that registers it."""

from functools import cache
from importlib.resources import files


@cache
def read_script(package: str, name: str) -> str:
    """Read the text of a script, once in a process.

    Args:
        package: dotted name of the package that holds the file.
        name: the file's name without `.lua`. Comments at its top say what its keys, arguments and results are.
    """
    return files(package).joinpath(f"{name}.lua").read_text("utf-8")
