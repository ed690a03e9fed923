"""A folder of the user's own PBR textures, grouped by file name and checked."""

import warnings
from collections import defaultdict
from io import BytesIO
from pathlib import Path

from PIL import Image
from pydantic import BaseModel, ConfigDict, Field

from assets.files import Checksum, read_bounded, sha256
from assets.scan.float_image import read_float_image
from assets.scan.texture_names import TextureName, TextureRole, parse_texture_name
from farm.errors import AssetError

SUFFIXES = frozenset({".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp", ".exr"})
FORMATS = ("JPEG", "PNG", "TIFF", "WEBP", "BMP")
SMALLEST_EDGE, LARGEST_EDGE = 16, 16384
"""Pixels along an edge that are accepted. Pillow also refuses images of more than about 179 million pixels."""

ENDINGS = "'_color', '_normal', '_rough', '_metal', '_ao' or '_height'"


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
        maps: At most one for each role, in the order of `TextureRole`.
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


def scan_textures(folder: Path) -> tuple[TextureSet, ...]:
    """Find the textures in a folder and its immediate subfolders, and decode every image.

    Args:
        folder: Images named as texture libraries name them: `<texture>_<map>`, with a resolution anywhere.

    Returns:
        The textures, sorted by name. One in a subfolder is called `<subfolder>/<texture>`, or `<subfolder>` if
        its files are named after the maps alone.

    Raises:
        AssetError: There is no texture, a file isn't a sound image of a sane size, its name doesn't say what it
            is for, two files are for the same thing, or a texture has no colour map.
    """
    if not folder.is_dir():
        raise AssetError(f"{folder}: isn't a folder; give the folder that holds your textures")
    named = _group(folder)
    if not named:
        raise AssetError(f"{folder}: holds no textures; put images there with names ending in {ENDINGS}")
    return tuple(_texture_set(name, named[name]) for name in sorted(named))


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
        _check_size(path, width, height)
    else:
        width, height = _decode(path, data)
    return TextureMap(role=role, path=path, sha256=sha256(data), width=width, height=height)


def _group(folder: Path) -> dict[str, list[tuple[TextureName, Path]]]:
    """Group a folder's files by the name of the texture."""
    named: dict[str, list[tuple[TextureName, Path]]] = defaultdict(list)
    stray: list[tuple[str, Path]] = []
    for path in _images(folder):
        found = parse_texture_name(path.stem)
        inner = "" if path.parent == folder else path.parent.name
        name = "/".join(part for part in (inner, found.texture) if part) or folder.name
        if found.role is not None:
            named[name].append((found, path))
        elif not found.unused:
            stray.append((name, path))
    for name, path in stray:
        # Libraries add a picture of the whole texture, named like it: that one is no map.
        if name not in named:
            raise AssetError(f"{path}: its name doesn't say what it is for; end it in {ENDINGS}, or remove it")
    return named


def _images(folder: Path) -> list[Path]:
    subfolders = [path for path in folder.iterdir() if path.is_dir() and not path.name.startswith(".")]
    return sorted(
        path
        for place in (folder, *subfolders)
        for path in place.iterdir()
        if path.suffix.lower() in SUFFIXES and path.is_file() and not path.name.startswith(".")
    )


def _texture_set(name: str, files: list[tuple[TextureName, Path]]) -> TextureSet:
    chosen: dict[TextureRole, tuple[TextureName, Path]] = {}
    for found, path in files:
        assert found.role is not None  # noqa: S101  # _group keeps only files with a role
        rival = chosen.get(found.role)
        if rival is None or _converted(found) < _converted(rival[0]):
            chosen[found.role] = (found, path)
        elif _converted(found) == _converted(rival[0]):
            raise AssetError(f"{path}: {rival[1].name} is the {found.role} map of {name!r} too; keep one of them")
    if TextureRole.COLOUR not in chosen:
        raise AssetError(f"{files[0][1]}: the texture {name!r} has no colour map; add one ending in '_color'")
    maps = tuple(read_map(role, chosen[role][1]) for role in TextureRole if role in chosen)
    return TextureSet(
        name=name,
        maps=maps,
        flip_green=TextureRole.NORMAL in chosen and chosen[TextureRole.NORMAL][0].directx,
        invert_roughness=TextureRole.ROUGHNESS in chosen and chosen[TextureRole.ROUGHNESS][0].gloss,
    )


def _converted(found: TextureName) -> bool:
    """Whether a map has to be converted; where a library gives both kinds, the other one is taken."""
    return found.directx or found.gloss


def _decode(path: Path, data: bytes) -> tuple[int, int]:
    advice = "save it again as PNG or JPEG"
    try:
        with warnings.catch_warnings():
            # Pillow warns of large images; the bounds below decide instead.
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(BytesIO(data), formats=FORMATS) as image:
                _check_size(path, image.width, image.height)
                image.load()
                return image.width, image.height
    except Image.DecompressionBombError as error:
        raise AssetError(f"{path}: has too many pixels to be decoded safely; scale it down") from error
    except (OSError, SyntaxError, ValueError) as error:
        raise AssetError(f"{path}: isn't a sound image ({error}); {advice}") from error


def _check_size(path: Path, width: int, height: int) -> None:
    if not (SMALLEST_EDGE <= width <= LARGEST_EDGE and SMALLEST_EDGE <= height <= LARGEST_EDGE):
        raise AssetError(
            f"{path}: {width} x {height} pixels is outside {SMALLEST_EDGE} to {LARGEST_EDGE} an edge; scale it"
        )
