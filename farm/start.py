"""Starts the farm's programs so that its own packages run, whatever else Python's path and the environment hold.

As a program, `python -I .../farm/start.py MODULE ARGUMENTS...` runs `MODULE.main(ARGUMENTS)`. It is named by its path,
and Python is isolated: neither the working folder, nor PYTHONPATH, nor the user's own site decides which `worker`,
`celery` or `numpy` is found. A person's project may have modules of these names.
"""

import importlib
import importlib.util
import os
import site
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NoReturn

ROOT = Path(__file__).resolve().parents[1]
"""Folder of the farm's own packages: that of the installation, or a checkout."""

PACKAGES = ("farm", "assets", "blend", "worker")


def program(module: str) -> tuple[str, ...]:
    """Build the start of the command that runs one of the farm's own modules, whose `main` takes the arguments."""
    # The encoding of file names must be the same on both sides; an isolated Python does not see PYTHONUTF8.
    return (sys.executable, "-I", "-X", f"utf8={sys.flags.utf8_mode}", str(ROOT / "farm" / "start.py"), module)


def become(module: str, arguments: Sequence[str], **more: str) -> NoReturn:
    """Run one of the farm's own modules in place of this process, in the farm's own environment and `more`."""
    from farm.environment import own_environment  # noqa: PLC0415 - the path must be in order first

    sys.stdout.flush()
    sys.stderr.flush()
    command = [*program(module), *arguments]
    os.execve(command[0], command, {**own_environment(), **more})  # noqa: S606 - no shell is wanted


def prepare() -> None:
    """Put this process's path and environment in order; to be called before anything heavy is imported.

    Ends the process with code 14 if a package of the farm's name was imported from elsewhere.
    """
    sys.path[:] = arranged(sys.path, _foreign(), str(ROOT))
    if found := foreign_package():
        # The farm's own errors may be among what is missing.
        sys.stderr.write(f"farm: {found}: stands in the place of the farm's own package; take it off Python's path\n")
        sys.exit(14)
    from farm.environment import clear  # noqa: PLC0415 - now it is ours

    clear()


def arranged(path: Sequence[str], foreign: Sequence[str], root: str) -> list[str]:
    """Arrange Python's path: its library, the farm's own packages, what is installed with them, then all else.

    Args:
        path: the path as it is.
        foreign: entries that are not the installation's, first come first.
        root: folder of the farm's own packages.

    Returns:
        The path with the foreign entries at its end: what the farm needs may be there alone, as with packages that are
        each in a folder of their own. An empty entry is left out.
    """
    library = str(Path(os.__file__).parent)
    rest = [entry for entry in path if entry and entry not in foreign and entry != root]
    standard = [entry for entry in rest if entry.endswith(".zip") or entry in {library, f"{library}/lib-dynload"}]
    installed = [entry for entry in rest if entry not in standard]
    return [*standard, root, *installed, *(entry for entry in dict.fromkeys(foreign) if entry and entry != root)]


def foreign_package() -> Path | None:
    """Find a package that has one of the farm's names but lies elsewhere: its file, or None."""
    for name in PACKAGES:
        spec = importlib.util.find_spec(name)
        place = None if spec is None else spec.origin or next(iter(spec.submodule_search_locations or ()), None)
        if place is not None and ROOT not in Path(place).resolve().parents:
            return Path(place)
    return None


def _foreign() -> list[str]:
    given = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    entries = [_absolute(entry) for entry in given if entry]
    if not sys.flags.safe_path and sys.path:
        # The folder of the script, or the working folder; `cable_farm` may have put the root before it.
        first = next((entry for entry in sys.path if entry != str(ROOT)), "")
        entries.append(_absolute(first))
    if site.ENABLE_USER_SITE:
        entries.append(site.getusersitepackages())
    # The programs that this one starts are isolated: they find these entries here.
    if entries:
        os.environ["PYTHONPATH"] = os.pathsep.join(dict.fromkeys(entries))
    return [*entries, *_as_written(entries, sys.path)]


def _as_written(entries: Iterable[str], path: Iterable[str]) -> list[str]:
    """The entries of a path that mean one of `entries`, however they are written."""
    wanted = set(entries)
    return [entry for entry in path if entry and entry not in wanted and _absolute(entry) in wanted]


def _absolute(entry: str) -> str:
    try:
        return str(Path(entry).absolute())
    except FileNotFoundError:
        # The working folder is gone, and nothing can be found in it.
        return entry


if __name__ == "__main__":
    _, wanted, *words = sys.argv
    prepare()
    importlib.import_module(wanted).main(words)
