"""Which files of a folder belong to one texture: grouped by their names, nothing is read."""

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from assets.scan.survey import LeftOut, aside, broken
from assets.scan.texture_names import TextureName, TextureRole, parse_texture_name

RENDERED = (TextureRole.COLOUR, TextureRole.NORMAL, TextureRole.ROUGHNESS, TextureRole.METALLIC)
"""Roles of the maps that the floor's material shows; those of other roles are left aside unread."""

ENDINGS = "'_color', '_normal', '_rough' or '_metal'"

_MEMBER = re.compile(r"(var|v)?\d{1,5}|[a-h]")
"""What may follow a texture's name in the names of those that share its maps: 'brick_a' and 'brick_b'."""


@dataclass(frozen=True, slots=True)
class _File:
    """A file, what its name means, and the name of the subfolder that it is in, or an empty one."""

    inner: str
    path: Path
    found: TextureName

    def texture(self, folder_name: str, *, numbered: bool = False) -> str:
        texture = self.found.numbered if numbered else self.found.texture
        return "/".join(part for part in (self.inner, texture) if part) or folder_name


_Groups = dict[str, list[_File]]
_Roles = dict[TextureRole, list[_File]]


@dataclass(frozen=True, slots=True)
class MapFile:
    """A file that may serve as a map.

    Attributes:
        path: The file.
        directx: Normal map whose green grows downwards.
        gloss: Roughness map that holds its opposite.
    """

    path: Path
    directx: bool
    gloss: bool


@dataclass(frozen=True, slots=True)
class Candidates:
    """A texture's files.

    Attributes:
        name: Name of the texture, unique in its folder.
        maps: The files for each role that is shown, the best first; there is always one for the colour.
    """

    name: str
    maps: Mapping[TextureRole, tuple[MapFile, ...]]


def group_by_texture(
    images: Iterable[tuple[str, Path]], folder_name: str
) -> tuple[tuple[Candidates, ...], tuple[LeftOut, ...]]:
    """Group files by the textures that their names speak of.

    Colour maps that are variants of each other become textures of their own, which share the other maps.

    Args:
        images: The name of the subfolder that a file is in, or an empty one, and its path.
        folder_name: Name of a texture whose files are named after the maps alone and lie in no subfolder.

    Returns:
        The textures, sorted by name, and the files that are used by none.
    """
    groups, strays = _groups([_File(inner, path, parse_texture_name(path.stem)) for inner, path in images], folder_name)
    notes = [_stray(file, folder_name, groups) for file in strays]
    shown: dict[str, _Roles] = {}
    for name, files in groups.items():
        shown[name] = defaultdict(list)
        for file in sorted(files, key=_preference):
            if file.found.role in RENDERED:
                shown[name][file.found.role].append(file)
            else:
                notes.append(aside(file.path, f"not used: {_purpose(file.found)}"))
    notes += [note for name in shown for note in _lend(name, shown)]
    textures = {
        "_".join(part for part in (name, variant) if part): {**roles, TextureRole.COLOUR: colours}
        for name, roles in shown.items()
        for variant, colours in _by_variant(roles[TextureRole.COLOUR]).items()
    }
    return tuple(Candidates(name, _map_files(textures[name])) for name in sorted(textures)), tuple(notes)


def _groups(files: list[_File], folder_name: str) -> tuple[_Groups, list[_File]]:
    """Group the files whose names say what they are for, by the texture's name; return the others beside them."""
    groups: _Groups = defaultdict(list)
    by_letter: _Groups = defaultdict(list)
    strays = []
    for file in files:
        if file.found.by_letter:
            by_letter[file.texture(folder_name)].append(file)
        elif file.found.role is not None or file.found.unused:
            groups[file.texture(folder_name)].append(file)
        else:
            strays.append(file)
    for name, lettered in by_letter.items():
        own = {file.found.role for file in lettered}
        others = {file.found.role for file in groups.get(name, ())}
        # 'brick_a' alone is any picture; beside 'brick_n' it is the colour of 'brick'.
        if TextureRole.COLOUR in own - others and TextureRole.NORMAL in own | others:
            groups[name] += lettered
        else:
            strays += lettered
    return _told_apart(groups, folder_name), strays


def _told_apart(groups: _Groups, folder_name: str) -> _Groups:
    """Split a group of several textures that only a number tells apart, such as 'rock_001' and 'rock_002'.

    A group that makes one texture keeps its name without the number.
    """
    apart: _Groups = defaultdict(list)
    for name, files in groups.items():
        kinds = [
            (found.role, found.variant, found.directx or found.gloss)
            for found in (file.found for file in files)
            if found.role is not None
        ]
        several = len(kinds) > len(set(kinds)) and len({file.found.numbered for file in files}) > 1
        for file in files:
            apart[file.texture(folder_name, numbered=True) if several else name].append(file)
    return apart


def _preference(file: _File) -> tuple[object, ...]:
    """Order maps of one role: without conversion, large, by the better known ending, by name."""
    found, name = file.found, file.path.name
    return (found.directx or found.gloss, -found.pixels, found.order, name.lower(), name)


def _purpose(found: TextureName) -> str:
    return f"a map of {found.role}" if found.role is not None else "a preview, or a map of another kind or of several"


def _stray(file: _File, folder_name: str, groups: _Groups) -> LeftOut:
    # Libraries add a picture of the whole texture, named like it: that one is no map.
    if file.texture(folder_name) in groups or file.texture(folder_name, numbered=True) in groups:
        return aside(file.path, "not used: a picture of the whole texture")
    return aside(file.path, f"its name doesn't say what it is for; end it in {ENDINGS}, or remove it")


def _lend(name: str, shown: Mapping[str, _Roles]) -> list[LeftOut]:
    """Give the maps of a texture without colour to those that are variants of it by name: 'brick_a' and 'brick_b'.

    Returns:
        Notes of the maps, if there is no such texture.
    """
    maps = shown[name]
    if maps[TextureRole.COLOUR]:
        return []
    start = f"{name}_"
    borrowers = [
        roles
        for other, roles in shown.items()
        if other.startswith(start) and _MEMBER.fullmatch(other.removeprefix(start)) and roles[TextureRole.COLOUR]
    ]
    for roles in borrowers:
        for role in RENDERED:
            roles[role] = roles[role] or maps[role]
    if borrowers:
        return []
    reason = f"the texture {name!r} has no colour map; add one ending in '_color'"
    return [broken(file.path, reason) for files in maps.values() for file in files]


def _by_variant(colours: list[_File]) -> dict[str, list[_File]]:
    variants: dict[str, list[_File]] = defaultdict(list)
    for file in colours:
        variants[file.found.variant].append(file)
    return variants


def _map_files(roles: _Roles) -> dict[TextureRole, tuple[MapFile, ...]]:
    return {
        role: tuple(MapFile(file.path, file.found.directx, file.found.gloss) for file in roles[role])
        for role in RENDERED
        if roles.get(role)
    }
