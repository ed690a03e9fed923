import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from assets.files import sha256
from assets.scan.texture_names import TextureRole
from assets.scan.textures import read_map, scan_textures, survey_textures
from farm.errors import AssetError
from tests.assets.scan.float_files import write_image


def picture(path: Path, size: tuple[int, int] = (32, 32)) -> Path:
    """Write a small picture in the format of its suffix."""
    path.parent.mkdir(parents=True, exist_ok=True)
    noise = np.random.default_rng(0).integers(0, 255, (size[1], size[0], 3), np.uint8)
    Image.fromarray(noise).save(path)
    return path


def test_files_are_grouped_by_texture(tmp_path: Path) -> None:
    """Two textures in one folder come apart, each with its maps in order, sizes and checksums."""
    for name in ("oak_diff_2k.jpg", "oak_nor_gl_2k.png", "oak_rough_2k.jpg", "slate_color.png"):
        picture(tmp_path / name)
    oak, slate = scan_textures(tmp_path)
    assert (oak.name, slate.name) == ("oak", "slate")
    roles = [found.role for found in oak.maps]
    assert roles == [TextureRole.COLOUR, TextureRole.NORMAL, TextureRole.ROUGHNESS]
    first = oak.maps[0]
    assert (first.width, first.height) == (32, 32)
    assert first.sha256 == sha256((tmp_path / "oak_diff_2k.jpg").read_bytes())
    assert not oak.flip_green
    assert slate.find(TextureRole.NORMAL) is None


@pytest.mark.parametrize("suffix", [".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp", ".PNG"])
def test_usual_formats_are_read(tmp_path: Path, suffix: str) -> None:
    """Each format is decoded."""
    picture(tmp_path / f"oak_color{suffix}")
    assert len(scan_textures(tmp_path)) == 1


def test_exr_maps_are_read(tmp_path: Path) -> None:
    """A map of roughness in an EXR file is read."""
    picture(tmp_path / "oak_color.png")
    write_image(tmp_path / "oak_rough.exr", np.full((32, 48, 1), 0.5, np.float32))
    found = scan_textures(tmp_path)[0].find(TextureRole.ROUGHNESS)
    assert found is not None
    assert (found.width, found.height) == (48, 32)


def test_subfolders_name_their_textures(tmp_path: Path) -> None:
    """Files named after the maps alone take the subfolder's name."""
    picture(tmp_path / "bricks" / "color.png")
    picture(tmp_path / "bricks" / "normal.png")
    picture(tmp_path / "woods" / "oak_color.png")
    assert [found.name for found in scan_textures(tmp_path)] == ["bricks", "woods/oak"]


def test_deeper_folders_are_not_read(tmp_path: Path) -> None:
    """Files below the subfolders are ignored."""
    picture(tmp_path / "oak_color.png")
    picture(tmp_path / "a" / "b" / "pine_color.png")
    assert [found.name for found in scan_textures(tmp_path)] == ["oak"]


def test_directx_normals_are_flagged(tmp_path: Path) -> None:
    """A DirectX normal map is flagged, as its green must be inverted."""
    picture(tmp_path / "oak_color.png")
    picture(tmp_path / "oak_NormalDX.png")
    assert scan_textures(tmp_path)[0].flip_green


def test_gloss_is_flagged(tmp_path: Path) -> None:
    """A gloss map is flagged, as gloss is the opposite of roughness."""
    picture(tmp_path / "oak_color.png")
    picture(tmp_path / "oak_gloss.png")
    assert scan_textures(tmp_path)[0].invert_roughness


def test_maps_that_need_no_conversion_are_preferred(tmp_path: Path) -> None:
    """An OpenGL normal map is preferred to a DirectX one, and roughness to gloss."""
    for name in ("oak_color.png", "oak_nor_dx.png", "oak_nor_gl.png", "oak_gloss.png", "oak_rough.png"):
        picture(tmp_path / name)
    found = scan_textures(tmp_path)[0]
    assert not found.flip_green
    assert not found.invert_roughness
    assert [entry.path.name for entry in found.maps] == ["oak_color.png", "oak_nor_gl.png", "oak_rough.png"]


def test_previews_and_packed_maps_are_left_out(tmp_path: Path) -> None:
    """A picture named like the texture, and maps of known other purposes, are left out without an error."""
    for name in ("Oak_Color.png", "Oak.png", "Oak_ARM.png", "Oak_Opacity.png"):
        picture(tmp_path / name)
    assert [entry.role for entry in scan_textures(tmp_path)[0].maps] == [TextureRole.COLOUR]


def test_a_name_that_says_nothing_is_refused(tmp_path: Path) -> None:
    """The error names a lone picture and advises how to call it."""
    picture(tmp_path / "floor.png")
    with pytest.raises(AssetError, match=r"floor\.png: its name doesn't say what it is for; end it in '_color'"):
        scan_textures(tmp_path)


def test_of_several_resolutions_the_largest_sound_one_is_taken(tmp_path: Path) -> None:
    """A map of a larger resolution that is broken gives way to a smaller one, and both others are listed."""
    for name in ("oak_color_1k.png", "oak_color_2k.png", "oak_color_4k.png"):
        picture(tmp_path / name)
    (tmp_path / "oak_color_4k.png").write_bytes(b"cut")
    survey = survey_textures(tmp_path)
    assert [entry.path.name for entry in survey.found[0].maps] == ["oak_color_2k.png"]
    assert [(entry.path.name, entry.broken) for entry in survey.left_out] == [
        ("oak_color_1k.png", False),
        ("oak_color_4k.png", True),
    ]


def test_a_broken_texture_leaves_the_others(tmp_path: Path) -> None:
    """A texture with a broken map is left out whole, since without the map it would look otherwise."""
    for name in ("oak_color.png", "slate_color.png", "slate_rough.png", "slate_normal.png"):
        picture(tmp_path / name)
    (tmp_path / "slate_rough.png").write_text("<html>not found</html>")
    survey = survey_textures(tmp_path)
    assert [texture.name for texture in survey.found] == ["oak"]
    assert {entry.path.name: entry.broken for entry in survey.left_out} == {
        "slate_color.png": False,
        "slate_normal.png": False,
        "slate_rough.png": True,
    }


def test_maps_that_are_not_shown_are_not_read(tmp_path: Path) -> None:
    """A height map, an occlusion map or a preview may be anything."""
    picture(tmp_path / "oak_color.png")
    for name in ("oak_height.png", "oak_bump.png", "oak_ao.png", "oak_preview.png", "oak.png", "oak_orm.png"):
        (tmp_path / name).write_bytes(b"")
    survey = survey_textures(tmp_path)
    assert [texture.name for texture in survey.found] == ["oak"]
    assert len(survey.left_out) == 6
    assert not any(entry.broken for entry in survey.left_out)


def test_unpacked_archives_are_read(tmp_path: Path) -> None:
    """Poly Haven's archives hold the maps in a folder 'textures' beside a .blend file."""
    picture(tmp_path / "leather_1k.blend" / "textures" / "leather_diff_1k.png")
    (tmp_path / "leather_1k.blend" / "leather_1k.blend").write_bytes(b"BLENDER")
    picture(tmp_path / "oak" / "oak_color.png")
    picture(tmp_path / "oak" / "textures" / "pine_color.png")
    assert [found.name for found in scan_textures(tmp_path)] == ["leather_1k.blend/leather", "oak/oak"]


def test_a_name_that_is_no_utf8_is_left_out(tmp_path: Path) -> None:
    """A header can't hold a path of other bytes; of a folder with such a name nothing is left."""
    picture(tmp_path / "oak_color.png")
    odd = tmp_path / os.fsdecode(b"caf\xe9_color.png")
    odd.write_bytes((tmp_path / "oak_color.png").read_bytes())
    survey = survey_textures(tmp_path)
    assert [texture.name for texture in survey.found] == ["oak"]
    assert [(entry.path, entry.broken) for entry in survey.left_out] == [(odd, True)]
    folder = tmp_path / os.fsdecode(b"\xe9t\xe9")
    folder.mkdir()
    (folder / "oak_color.png").write_bytes((tmp_path / "oak_color.png").read_bytes())
    with pytest.raises(AssetError, match="isn't UTF-8; rename"):
        scan_textures(folder)


def test_a_texture_without_colour_is_refused(tmp_path: Path) -> None:
    """A texture with a normal map alone is refused."""
    picture(tmp_path / "oak_normal.png")
    with pytest.raises(AssetError, match="'oak' has no colour map"):
        scan_textures(tmp_path)


@pytest.mark.parametrize("made", [True, False])
def test_an_empty_or_missing_folder_is_refused(tmp_path: Path, made: bool) -> None:
    """A folder that is missing or holds no texture is refused."""
    folder = tmp_path / "textures"
    if made:
        folder.mkdir()
    with pytest.raises(AssetError, match=r"holds no textures|isn't a folder"):
        scan_textures(folder)


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".tif", ".webp", ".bmp"])
@pytest.mark.parametrize("share", [0.02, 0.5, 0.9])
def test_a_truncated_image_is_refused(tmp_path: Path, suffix: str, share: float) -> None:
    """A file that is cut anywhere is refused, as decoding goes to its end."""
    path = picture(tmp_path / f"oak_color{suffix}", (64, 64))
    data = path.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(AssetError, match=f"oak_color{suffix}: isn't a sound image"):
        scan_textures(tmp_path)


def test_text_is_no_image(tmp_path: Path) -> None:
    """A text file with the name of an image is refused."""
    (tmp_path / "oak_color.png").write_text("<html>not found</html>")
    with pytest.raises(AssetError, match="isn't a sound image"):
        scan_textures(tmp_path)


@pytest.mark.parametrize("size", [(15, 64), (64, 15), (16385, 16)])
def test_sizes_out_of_bounds_are_refused(tmp_path: Path, size: tuple[int, int]) -> None:
    """An edge below 16 or above 16384 pixels is refused."""
    with pytest.raises(AssetError, match="is outside 16 to 16384 an edge"):
        read_map(TextureRole.COLOUR, picture(tmp_path / "oak_color.png", size))


def test_a_decompression_bomb_is_refused(tmp_path: Path) -> None:
    """A small file that would unpack to a quarter of a gigapixel is refused."""
    path = tmp_path / "oak_color.png"
    Image.new("1", (16000, 16000)).save(path)
    with pytest.raises(AssetError, match="too many pixels"):
        read_map(TextureRole.COLOUR, path)
