"""`python -m tests.rooms worker farm`: the rooms of a package, the imports between them, and the floors these make.

A room of a package is a folder or a module directly in it, its `__init__.py` aside. An arrow goes from a room to each
other room that it imports. A room lies one floor above the highest room that it imports.
"""

import ast
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

ROOT = Path(__file__).parents[1]

Arrows = Mapping[str, frozenset[str]]
"""The rooms that each room imports, by name."""


class CircleError(Exception):
    """Rooms import each other round a circle, so they form no floors."""


def modules(*tops: str, root: Path = ROOT) -> dict[str, Path]:
    """Every module below some packages, by its dotted name."""
    found = {}
    for top in tops:
        for file in sorted((root / top).rglob("*.py")):
            parts = file.relative_to(root).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = file
    return found


def imports(tree: ast.AST) -> Iterator[str]:
    """The dotted names that a module imports anywhere in its text, inside functions too."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def is_in(name: str, *rooms: str) -> bool:
    """Whether a dotted name is one of the rooms, or lies in one."""
    return any(name == room or name.startswith(f"{room}.") for room in rooms)


def arrows(package: str, root: Path = ROOT) -> Arrows:
    """The arrows between the rooms of a package."""
    every = {name: file for name, file in modules(package, root=root).items() if name != package}
    rooms: dict[str, set[str]] = {name.split(".")[1]: set() for name in every}
    for name, file in every.items():
        room = name.split(".")[1]
        for imported in imports(ast.parse(file.read_text(encoding="utf-8"))):
            parts = imported.split(".")
            if parts[0] == package and len(parts) > 1 and parts[1] in rooms and parts[1] != room:
                rooms[room].add(parts[1])
    return {room: frozenset(targets) for room, targets in rooms.items()}


def floors(between: Arrows) -> dict[str, int]:
    """The floor of each room, 1 for rooms that import no other.

    Raises:
        CircleError: if rooms import each other round a circle.
    """
    found: dict[str, int] = {}

    def floor(room: str, trail: tuple[str, ...]) -> int:
        if room in trail:
            raise CircleError(" -> ".join((*trail[trail.index(room) :], room)))
        if room not in found:
            found[room] = 1 + max((floor(target, (*trail, room)) for target in sorted(between[room])), default=0)
        return found[room]

    for room in between:
        floor(room, ())
    return found


def main(packages: list[str]) -> None:
    """Print a line for each package, and one for each of its rooms."""
    for package in packages:
        between = arrows(package)
        heights = floors(between)
        count = sum(len(targets) for targets in between.values())
        print(f"{package}: {len(between)} rooms on {max(heights.values())} floors, {count} arrows")
        for room in sorted(between, key=lambda room: (-heights[room], room)):
            print(f"  floor {heights[room]}  {room}: {', '.join(sorted(between[room])) or '-'}")


if __name__ == "__main__":
    main(sys.argv[1:])
