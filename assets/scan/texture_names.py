"""The meaning of texture libraries' file names: the texture, the map, the map's convention, and the colour's variant.

The tables hold the names of Poly Haven, ambientCG, Poliigon, Megascans, cgbookcase, ShareTextures, FreePBR, TextureCan,
GameTextures, 3DTextures and Substance.
"""

import re
from dataclasses import dataclass, field
from enum import StrEnum


class TextureRole(StrEnum):
    """What a map is for."""

    COLOUR = "colour"
    NORMAL = "normal"
    ROUGHNESS = "roughness"
    METALLIC = "metallic"
    OCCLUSION = "occlusion"
    HEIGHT = "height"


@dataclass(frozen=True)
class TextureName:
    """The meaning of a file's name.

    Attributes:
        texture: Name of the texture that the map belongs to, in lower case, parts joined by '_'; may be empty.
        role: Role of the map; None if the name doesn't say, or for maps that a renderer here can't use.
        directx: Normal map whose green grows downwards.
        gloss: Roughness map that holds its opposite.
        unused: The map's purpose is known, but it isn't used here (packed, opacity, previews and the like).
        variant: Which of several colours of one texture a map is, such as 'coll1' or 'var2'; empty if it doesn't say.
        numbered: The texture's name with its numbers of three to five digits, which `texture` leaves out.
        pixels: Pixels along an edge that the name speaks of; 0 if it doesn't say.
        order: Place among maps of the same role and size: the lowest is taken.
        by_letter: The meaning is that of a single letter, which counts only beside other maps named in this way.
    """

    texture: str
    role: TextureRole | None
    directx: bool = False
    gloss: bool = False
    unused: bool = False
    variant: str = ""
    numbered: str = field(default="", compare=False)
    pixels: int = field(default=0, compare=False)
    order: int = field(default=0, compare=False)
    by_letter: bool = field(default=False, compare=False)


_ROLES: dict[TextureRole, tuple[str, ...]] = {
    TextureRole.COLOUR: (
        "basecolor", "basecolour", "color", "colour", "albedo", "alb", "col", "coll", "diff", "diffuse", "basemap",
    ),
    TextureRole.NORMAL: ("nor", "normal", "nrm", "norm", "normals", "norgl", "normalgl", "normalogl", "normalopengl"),
    TextureRole.ROUGHNESS: ("rough", "roughness", "rgh"),
    TextureRole.METALLIC: ("metal", "metallic", "metalness", "mtl"),
    TextureRole.OCCLUSION: ("ao", "ambientocclusion", "occlusion", "occ", "mixedao"),
    TextureRole.HEIGHT: ("disp", "displacement", "height", "bump"),
}  # fmt: skip  # one a line would make a page of this list
"""Endings of each role, the best first: of two maps of one role, the one with the earlier ending is taken."""

_DIRECTX = ("nordx", "normaldx", "normaldirectx", "nrmdx", "normdx")
_GLOSS = ("gloss", "glossiness", "glossy", "smoothness")
_UNUSED = (
    "arm", "orm", "rma", "mra", "mrao", "rmao", "aorm", "maskmap", "opacity", "alpha", "mask", "spec", "specular",
    "specularity", "refl", "reflection", "emission", "emissive", "emit", "preview", "thumb", "thumbnail", "render",
    "sphere", "cavity", "curvature", "thickness", "translucency", "translucent", "transmission", "transparency",
    "scattering", "sss", "fuzz", "sheen", "idmap", "objectid", "diffuseoriginal", "alphamasked", "ior",
)  # fmt: skip  # one a line would make a page of this list

_Meaning = tuple[TextureRole | None, bool, bool, int]

_MEANINGS: dict[str, _Meaning] = {
    **{word: (role, False, False, place) for role, words in _ROLES.items() for place, word in enumerate(words)},
    **dict.fromkeys(_DIRECTX, (TextureRole.NORMAL, True, False, 0)),
    **dict.fromkeys(_GLOSS, (TextureRole.ROUGHNESS, False, True, 0)),
    **dict.fromkeys(_UNUSED, (None, False, False, 0)),
}
"""Meaning of each ending, its parts run together: the role, whether it is DirectX's, whether it is a gloss map, and its
place among the endings of its role."""

_LETTERS: dict[str, _Meaning] = {
    **{word: (TextureRole.COLOUR, False, False, place) for place, word in enumerate(("bc", "b", "d", "a"))},
    "n": (TextureRole.NORMAL, False, False, 0),
    "r": (TextureRole.ROUGHNESS, False, False, 0),
    "m": (TextureRole.METALLIC, False, False, 0),
    "o": (TextureRole.OCCLUSION, False, False, 0),
    "h": (TextureRole.HEIGHT, False, False, 0),
    **dict.fromkeys(("c", "e", "s"), (None, False, False, 0)),
}
"""Endings of one or two letters, as in 'T_vfekbbeqy_2K_B' and 'WoodBarrel_2k_d'; 'c' holds several maps."""

_QUALIFIERS = {"gl", "ogl", "opengl", "dx", "directx"}
_NOISE = re.compile(r"\d{1,2}k|\d{3,5}(x\d{3,5})?(px)?|jpg|jpeg|png|tif|tiff|exr|webp|bmp|\d{1,2}bit")
"""Parts that say nothing about the map: resolutions, formats, bit depths."""

_NUMBER = re.compile(r"\d{3,5}")
_EDGES = frozenset(str(2**exponent) for exponent in range(7, 15))
"""Numbers that are taken for pixels along an edge; others, such as 001, tell textures apart."""

_WORKFLOWS = {"metalness", "specular"}
"""Ends of Poliigon's names such as 'Slate001_COL_2K_METALNESS', which say what the set is made for, not the map."""

_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z][a-z])|(?<=[a-z])(?=[A-Z]{2}\b)")
_LOD = re.compile(r"lod(\d)")
_DEEP = re.compile(r"(nrm|disp|bump|gloss|col)16")
"""Poliigon's maps of 16 bits, such as NRM16, beside those of 8."""
_VARIANT = re.compile(r"var\d{1,2}|v\d{1,2}|\d{1,2}|[a-h]")
_GLUED = re.compile(r"([a-z]+)(\d{1,2})")


def parse_texture_name(stem: str) -> TextureName:
    """Read a file's name without its suffix.

    Args:
        stem: Name without suffix, such as 'Bricks075_2K-JPG_NormalGL' or 'oak floor diff 4k'.

    Returns:
        The meaning of the name. Case doesn't matter; parts are separated by '_', '-', '.', spaces or inner capitals.
    """
    spaced = _CAMEL.sub("_", stem)
    parts = [part for part in re.split(r"[_\-. ]+", spaced.lower()) if part]
    if len(parts) > 2 and parts[-1] in _WORKFLOWS and re.fullmatch(r"\d{1,2}k", parts[-2]):
        whole = _read(parts[:-1])
        if whole.role is not None:
            return whole
    return _read(parts)


def _read(parts: list[str]) -> TextureName:
    kept = [index for index, part in enumerate(parts) if not _NOISE.fullmatch(part)]
    words = [parts[index] for index in kept]
    for reading in (_plain, _variant, _letter):
        found = reading(words)
        if found is not None:
            (role, directx, gloss, order), length, variant = found
            first = kept[len(kept) - length]
            return TextureName(
                "_".join(words[: len(words) - length]),
                role,
                directx,
                gloss,
                unused=role is None,
                variant=variant,
                numbered=_numbered(parts[:first]),
                pixels=_pixels(parts),
                order=order,
                by_letter=reading is _letter,
            )
    return TextureName("_".join(words), None, numbered=_numbered(parts), pixels=_pixels(parts))


_Found = tuple[_Meaning, int, str] | None
"""A meaning, the number of parts at the end that give it, and the variant."""


def _plain(words: list[str]) -> _Found:
    """Read an ending of the tables. The longest wins: 'normal dx' before 'dx', 'base color' before 'color'."""
    for length in (3, 2, 1):
        ending = words[-length:]
        if len(ending) < length:
            continue
        meaning = _MEANINGS.get("".join(ending))
        if meaning is not None and not (length == 1 and ending[0] in _QUALIFIERS):
            return meaning, length, ""
    return None


def _variant(words: list[str]) -> _Found:
    """Read an ending that says more than the map: a level of detail, 16 bits, or one of several colours."""
    if not words:
        return None
    last, before = words[-1], words[:-1]
    if _LOD.fullmatch(last) and (found := _plain(before) or _variant(before)):
        (role, directx, gloss, order), length, variant = found
        return (role, directx, gloss, order + 100 * (1 + int(last[3:]))), length + 1, variant
    if (deep := _DEEP.fullmatch(last)) and (found := _plain([*before, deep[1]])):
        (role, directx, gloss, order), length, _ = found
        return (role, directx, gloss, order + 50), length, ""
    if (glued := _GLUED.fullmatch(last)) and (found := _plain([*before, glued[1]])):
        return _coloured(found[0], found[1], last)
    if _VARIANT.fullmatch(last) and (found := _plain(before)):
        return _coloured(found[0], found[1] + 1, last if last.startswith("v") else f"{words[-2]}_{last}")
    return None


def _coloured(meaning: _Meaning, length: int, variant: str) -> _Found:
    """Take variants of colours alone: 'rusty_metal_02' is no map of metal."""
    return (meaning, length, variant) if meaning[0] is TextureRole.COLOUR else None


def _letter(words: list[str]) -> _Found:
    if len(words) < 2 or words[-1] not in _LETTERS:
        return None
    return _LETTERS[words[-1]], 1, ""


def _numbered(parts: list[str]) -> str:
    """Join the parts that tell a texture from others: words, and numbers that are no resolution."""
    return "_".join(
        part for part in parts if not _NOISE.fullmatch(part) or (_NUMBER.fullmatch(part) and part not in _EDGES)
    )


def _pixels(parts: list[str]) -> int:
    """Return the last resolution that a name speaks of, or 0."""
    for part in reversed(parts):
        if re.fullmatch(r"\d{1,2}k", part):
            return 1024 * int(part[:-1])
        if re.fullmatch(r"\d{3,5}x\d{3,5}(px)?", part):
            return int(part.split("x")[0])
        if part.removesuffix("px") in _EDGES:
            return int(part.removesuffix("px"))
    return 0
