"""Another release of the farm: this one's packages under another version, with a key more in headers."""

import shutil
from pathlib import Path

import farm

VERSION = "999.0.0"

_PACKAGES = ("farm", "worker", "assets", "blend")


def make_other_release(folder: Path) -> Path:
    """Copy the farm's packages and the stand-in's program, and make them another release.

    Returns:
        The folder, which PYTHONPATH may name.
    """
    root = Path(farm.__file__).parents[1]
    for package in _PACKAGES:
        shutil.copytree(root / package, folder / package, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "tests").mkdir()
    shutil.copy(Path(__file__).parents[1] / "stand_in.py", folder / "tests")
    _edit(folder / "farm/__init__.py", f'__version__ = "{farm.__version__}"', f'__version__ = "{VERSION}"')
    key = "    farm_version: str\n"
    _edit(folder / "farm/spec/header.py", key, f"{key}    novelty: int = 0\n")
    return folder


def _edit(path: Path, present: str, wanted: str) -> None:
    text = path.read_text()
    if text.count(present) != 1:
        raise ValueError(f"{path}: {present!r} isn't there once")
    path.write_text(text.replace(present, wanted))
