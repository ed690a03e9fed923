"""The meaning of texture libraries' file names: the texture, the map, and the map's convention."""

import re
from dataclasses import dataclass
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
    """

    texture: str
    role: TextureRole | None
    directx: bool = False
    gloss: bool = False
    unused: bool = False


_ROLES: dict[TextureRole, tuple[str, ...]] = {
    TextureRole.COLOUR: ("color", "colour", "col", "diff", "diffuse", "albedo", "basecolor", "basecolour", "alb"),
    TextureRole.NORMAL: ("nor", "normal", "nrm", "norm", "normals", "norgl", "normalgl", "normalogl", "normalopengl"),
    TextureRole.ROUGHNESS: ("rough", "roughness", "rgh"),
    TextureRole.METALLIC: ("metal", "metallic", "metalness", "mtl"),
    TextureRole.OCCLUSION: ("ao", "ambientocclusion", "occlusion", "occ"),
    TextureRole.HEIGHT: ("disp", "displacement", "height", "bump"),
}
_DIRECTX = ("nordx", "normaldx", "normaldirectx", "nrmdx", "normdx")
_GLOSS = ("gloss", "glossiness", "glossy", "smoothness")
_UNUSED = (
    "arm", "orm", "rma", "opacity", "alpha", "mask", "spec", "specular", "emission", "emissive", "preview",
    "thumb", "thumbnail", "render", "sphere", "cavity", "translucency", "fuzz", "idmap",
)  # fmt: skip  # one a line would make a page of this list

_MEANINGS: dict[str, tuple[TextureRole | None, bool, bool]] = {
    **{word: (role, False, False) for role, words in _ROLES.items() for word in words},
    **dict.fromkeys(_DIRECTX, (TextureRole.NORMAL, True, False)),
    **dict.fromkeys(_GLOSS, (TextureRole.ROUGHNESS, False, True)),
    **dict.fromkeys(_UNUSED, (None, False, False)),
}
"""Meaning of each ending, its parts run together: the role, whether it is DirectX's, whether it is a gloss map."""

_QUALIFIERS = {"gl", "ogl", "opengl", "dx", "directx"}
_NOISE = re.compile(r"\d{1,2}k|\d{3,5}(x\d{3,5})?(px)?|jpg|jpeg|png|tif|tiff|exr|webp|bmp|\d{1,2}bit")
"""Parts that say nothing about the map: resolutions, formats, bit depths."""

_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z][a-z])|(?<=[a-z])(?=[A-Z]{2}\b)")


def parse_texture_name(stem: str) -> TextureName:
    """Read a file's name without its suffix.

    Args:
        stem: Name without suffix, such as 'Bricks075_2K-JPG_NormalGL' or 'oak floor diff 4k'.

    Returns:
        The meaning of the name. Case doesn't matter; parts are separated by '_', '-', '.', spaces or inner capitals.
    """
    spaced = _CAMEL.sub("_", stem)
    parts = [part for part in re.split(r"[_\-. ]+", spaced.lower()) if part]
    kept = [part for part in parts if not _NOISE.fullmatch(part)]
    # The longest ending wins: 'normal dx' before 'dx', 'base color' before 'color'.
    for length in (3, 2, 1):
        ending = kept[-length:]
        if len(ending) < length:
            continue
        meaning = _MEANINGS.get("".join(ending))
        if meaning is None or (length == 1 and ending[0] in _QUALIFIERS):
            continue
        role, directx, gloss = meaning
        return TextureName("_".join(kept[:-length]), role, directx, gloss, unused=role is None)
    return TextureName("_".join(kept), None)
