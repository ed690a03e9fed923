import pytest
from hypothesis import given
from hypothesis import strategies as st

from assets.scan.texture_names import TextureName, TextureRole, parse_texture_name

COLOUR, NORMAL, ROUGHNESS = TextureRole.COLOUR, TextureRole.NORMAL, TextureRole.ROUGHNESS

ENDINGS = {
    **dict.fromkeys(["color", "colour", "col", "diff", "diffuse", "albedo", "basecolor", "base_color"], COLOUR),
    **dict.fromkeys(["nor", "normal", "nor_gl", "normalgl", "nrm", "nor_dx", "normaldx", "normal_dx"], NORMAL),
    **dict.fromkeys(["rough", "roughness", "gloss"], ROUGHNESS),
    **dict.fromkeys(["metal", "metallic", "metalness"], TextureRole.METALLIC),
    **dict.fromkeys(["ao", "ambient_occlusion"], TextureRole.OCCLUSION),
    **dict.fromkeys(["disp", "height", "displacement"], TextureRole.HEIGHT),
}


@pytest.mark.parametrize(
    ("stem", "expected"),
    [
        ("wood_floor_diff_2k", TextureName("wood_floor", COLOUR)),
        ("wood_floor_nor_gl_4k", TextureName("wood_floor", NORMAL)),
        ("wood_floor_nor_dx_4k", TextureName("wood_floor", NORMAL, directx=True)),
        ("wood_floor_arm_2k", TextureName("wood_floor", None, unused=True)),
        ("Bricks075A_2K-JPG_Color", TextureName("bricks075a", COLOUR)),
        ("Bricks075A_2K-JPG_NormalGL", TextureName("bricks075a", NORMAL)),
        ("Bricks075A_2K-JPG_NormalDX", TextureName("bricks075a", NORMAL, directx=True)),
        ("Bricks075A_2K-JPG_AmbientOcclusion", TextureName("bricks075a", TextureRole.OCCLUSION)),
        ("vbsmdbc_2K_Albedo", TextureName("vbsmdbc", COLOUR)),
        ("vbsmdbc_2K_Gloss", TextureName("vbsmdbc", ROUGHNESS, gloss=True)),
        ("rusted-iron_normal-ogl", TextureName("rusted_iron", NORMAL)),
        ("rusted-iron_normal-dx", TextureName("rusted_iron", NORMAL, directx=True)),
        ("Oak.BaseColor.4096x4096", TextureName("oak", COLOUR)),
        ("oak 4K base color", TextureName("oak", COLOUR)),
        ("basecolor", TextureName("", COLOUR)),
        ("color_me_normal", TextureName("color_me", NORMAL)),
        ("Bricks075A", TextureName("bricks075a", None)),
        ("colorful_floor", TextureName("colorful_floor", None)),
    ],
)
def test_names_of_the_usual_libraries_are_understood(stem: str, expected: TextureName) -> None:
    """Names as Poly Haven, ambientCG, Quixel and FreePBR write them are understood, and names that say nothing."""
    assert parse_texture_name(stem) == expected


@given(
    texture=st.lists(st.sampled_from(["oak", "floor", "tile", "old", "brick7"]), min_size=1, max_size=3),
    ending=st.sampled_from(sorted(ENDINGS)),
    resolution=st.sampled_from(["", "1k", "2K", "4k", "16K", "2048"]),
    place=st.integers(0, 3),
    separator=st.sampled_from("_-. "),
    case=st.sampled_from([str.lower, str.upper, str.title]),
)
def test_separator_case_and_resolution_do_not_matter(
    texture: list[str],
    ending: str,
    resolution: str,
    place: int,
    separator: str,
    case: type[str],
) -> None:
    """Any ending, after any separator, in any case, with a resolution anywhere, gives its role and the texture."""
    parts = [*texture, *ending.split("_")]
    if resolution:
        parts.insert(min(place, len(parts)), resolution)
    found = parse_texture_name(separator.join(case(part) for part in parts))
    assert found.role is ENDINGS[ending]
    assert found.texture == "_".join(texture)
    assert found.directx == ending.endswith("dx")
    assert found.gloss == (ending == "gloss")


@given(st.text(max_size=60))
def test_any_name_can_be_read(stem: str) -> None:
    """No name, however odd, makes the reader fail."""
    assert parse_texture_name(stem).texture == parse_texture_name(stem).texture.lower()
