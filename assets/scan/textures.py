"""A folder of the user's own PBR textures, grouped by file name and checked."""

import stat
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field

from assets.files import Checksum, read_bounded, sha256
from assets.scan.float_image import read_float_image
from assets.scan.survey import LeftOut, Survey, aside, broken, entries_of, mode_of, sort_out
from assets.scan.texture_image import LARGEST_EDGE, SMALLEST_EDGE, check_size, check_texture
from assets.scan.texture_names import TextureRole, parse_texture_name
from assets.scan.texture_sets import ENDINGS, Candidates, MapFile, group_by_texture
from farm.errors import AssetError

SUFFIXES = frozenset({".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp", ".exr"})

UNPACKED = "textures"
"""Name of the folder in which Poly Haven's archives hold the maps, beside a .blend file."""


class TextureMap(BaseModel):
    """One image of a texture.

    Attributes:
        role: Role of the map.
        path: Path of the file.
        sha256: Checksum of the file.
        width: Pixels across.
        height: Pixels down.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    role: TextureRole
    path: Path
    sha256: Checksum
    width: int = Field(ge=SMALLEST_EDGE, le=LARGEST_EDGE)
    height: int = Field(ge=SMALLEST_EDGE, le=LARGEST_EDGE)


class TextureSet(BaseModel):
    """The images that together make a texture; there is always a colour map.

    Attributes:
        name: Unique within the scanned folder.
        maps: At most one for each role that is shown, in the order of `TextureRole`.
        flip_green: The normal map is of DirectX's convention: its green has to be inverted.
        invert_roughness: The roughness map holds gloss: it has to be inverted.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    maps: tuple[TextureMap, ...]
    flip_green: bool = False
    invert_roughness: bool = False

    def find(self, role: TextureRole) -> TextureMap | None:
        """Find the map of a role, or None if the set has none."""
        return next((found for found in self.maps if found.role is role), None)


def survey_textures(folder: Path) -> Survey[TextureSet]:
    """Find the textures in a folder and its immediate subfolders, and decode every image that is shown.

    Of several files for one map, the one without conversion is taken, then the largest that is sound. A texture one of
    whose maps has no sound file is left out.

    Args:
        folder: Images named as texture libraries name them: `<texture>_<map>`, with a resolution anywhere.

    Returns:
        The textures, and the files that none uses. A texture in a subfolder is called `<subfolder>/<texture>`, or
        `<subfolder>` if its files are named after the maps alone; the variants of a colour end in their own names.

    Raises:
        AssetError: It is no folder, or can't be listed.
    """
    images, left_out = _images(folder)
    textures, notes = group_by_texture(images, folder.name)
    left_out += notes
    found, checked = [], _CheckedMaps()
    for texture in textures:
        made = _texture_set(texture, checked)
        if made is not None:
            found.append(made)
    left_out += checked.broken.values()
    used = {entry.path for made in found for entry in made.maps}
    spare = {file.path for texture in textures for files in texture.maps.values() for file in files}
    left_out += [_spare(path, textures, used) for path in spare - used - set(checked.broken)]
    return Survey(tuple(found), tuple(sorted(left_out, key=lambda entry: entry.path)))


def scan_textures(folder: Path) -> tuple[TextureSet, ...]:
    """Find the textures in a folder; see `survey_textures`.

    Returns:
        The textures, sorted by name.

    Raises:
        AssetError: There is none that can be used.
    """
    survey = survey_textures(folder)
    return survey.needed(folder, f"no textures, which are images with names ending in {ENDINGS},")


def read_map(role: TextureRole, path: Path) -> TextureMap:
    """Decode an image completely.

    Args:
        role: Role of the map.
        path: Path of the file.

    Returns:
        The map, with its size and checksum.

    Raises:
        AssetError: It isn't a sound image, or its size is out of bounds.
    """
    data = read_bounded(path)
    if path.suffix.lower() == ".exr":
        height, width = read_float_image(path).shape[:2]
        check_size(path, width, height)
    else:
        width, height = check_texture(path, data)
    return TextureMap(role=role, path=path, sha256=sha256(data), width=width, height=height)


class _CheckedMaps:
    """The maps that a survey has decoded: variants of a colour share them."""

    def __init__(self) -> None:
        self._read: dict[tuple[TextureRole, Path], TextureMap] = {}
        self.broken: dict[Path, LeftOut] = {}

    def first_sound(self, role: TextureRole, files: tuple[MapFile, ...]) -> tuple[MapFile, TextureMap] | None:
        """Decode files in turn until one is sound; None if none is."""
        for file in files:
            if file.path in self.broken:
                continue
            try:
                found = self._read.get((role, file.path)) or read_map(role, file.path)
            except AssetError as error:
                self.broken[file.path] = broken(file.path, error)
                continue
            self._read[role, file.path] = found
            return file, found
        return None


def _texture_set(texture: Candidates, checked: _CheckedMaps) -> TextureSet | None:
    maps, flip_green, invert_roughness = [], False, False
    for role, files in texture.maps.items():
        chosen = checked.first_sound(role, files)
        if chosen is None:
            return None
        file, found = chosen
        maps.append(found)
        flip_green |= file.directx
        invert_roughness |= file.gloss
    return TextureSet(name=texture.name, maps=tuple(maps), flip_green=flip_green, invert_roughness=invert_roughness)


def _spare(path: Path, textures: tuple[Candidates, ...], used: set[Path]) -> LeftOut:
    """Say why a sound or unread file is not used: another one is its map, or a map beside it is broken."""
    for texture in textures:
        for files in texture.maps.values():
            paths = [file.path for file in files]
            chosen = next((other for other in paths if other in used), None)
            if path in paths and chosen is not None:
                return aside(path, f"not used: {chosen.name} is the same map")
    return aside(path, "not used: another map of its texture is broken")


def _images(folder: Path) -> tuple[list[tuple[str, Path]], list[LeftOut]]:
    """List the images of a folder and its subfolders, each with the name of its subfolder, sorted by path."""
    images, left_out = [], []
    entries = entries_of(folder, "give the folder that holds your textures")
    subfolders = [path for path in entries if stat.S_ISDIR(mode_of(path))]
    for place in (None, *subfolders):
        try:
            inner = entries if place is None else entries_of(place, "remove it")
        except AssetError as error:
            left_out.append(broken(folder if place is None else place, error))
            continue
        wanted, notes = _without_folders(inner)
        if place is not None and not any(_is_map(path) for path in wanted):
            deeper, more = _without_folders(_unpacked(place))
            wanted, notes = wanted + deeper, notes + more
        images += [("" if place is None else place.name, path) for path in wanted]
        left_out += notes
    return sorted(images, key=lambda image: image[1]), left_out


def _without_folders(entries: list[Path]) -> tuple[list[Path], list[LeftOut]]:
    return sort_out([path for path in entries if not stat.S_ISDIR(mode_of(path))], SUFFIXES, "PNG, JPEG, TIFF or EXR")


def _is_map(path: Path) -> bool:
    found = parse_texture_name(path.stem)
    return found.role is not None or found.unused


def _unpacked(place: Path) -> list[Path]:
    try:
        return entries_of(place / UNPACKED, "")
    except AssetError:
        return []
