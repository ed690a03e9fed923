"""Grouping files by texture, with the names that libraries give them."""

from collections.abc import Mapping
from pathlib import Path

import pytest

from assets.scan.texture_names import TextureRole
from assets.scan.texture_sets import group_by_texture

C, N, R, M = TextureRole.COLOUR, TextureRole.NORMAL, TextureRole.ROUGHNESS, TextureRole.METALLIC

Maps = Mapping[str, Mapping[TextureRole, str]]

FABRIC = "FabricCanvas001_1k/FabricCanvas001"
SLATE = "TilesSlateSquare001"
LIBRARIES: dict[str, tuple[list[str], Maps]] = {
    "Poly Haven": (
        [
            *(f"wood_table_001_{part}_1k.jpg" for part in ("diff", "nor_gl", "nor_dx", "rough", "ao", "disp", "arm")),
            "wood_table_001_spec_1k.png",
        ],
        {
            "wood_table": {
                C: "wood_table_001_diff_1k.jpg",
                N: "wood_table_001_nor_gl_1k.jpg",
                R: "wood_table_001_rough_1k.jpg",
            }
        },
    ),
    "Poly Haven, colours": (
        [f"leather_red_02_{part}_1k.png" for part in ("coll1", "coll2", "rough", "disp", "ao", "spec")]
        + ["leather_red_02_nor_gl_1k.exr", "leather_red_02_nor_dx_1k.exr"],
        {
            f"leather_red_02_coll{number}": {
                C: f"leather_red_02_coll{number}_1k.png",
                N: "leather_red_02_nor_gl_1k.exr",
                R: "leather_red_02_rough_1k.png",
            }
            for number in (1, 2)
        },
    ),
    "Poly Haven, numbered colours": (
        ["fabric_pattern_05_col_01_1k.jpg", "fabric_pattern_05_col_02_1k.jpg", "fabric_pattern_05_nor_dx_1k.jpg"],
        {
            f"fabric_pattern_05_col_0{number}": {
                C: f"fabric_pattern_05_col_0{number}_1k.jpg",
                N: "fabric_pattern_05_nor_dx_1k.jpg",
            }
            for number in (1, 2)
        },
    ),
    "Poly Haven, a bump map too": (
        [f"brown_planks_03_{part}_2k.png" for part in ("diff", "bump", "disp", "translucent", "mask")],
        {"brown_planks_03": {C: "brown_planks_03_diff_2k.png"}},
    ),
    "Poly Haven, several": (
        ["brick_wall_001_diffuse_4k.jpg", "brick_wall_003_diffuse_4k.jpg", "brick_wall_003_nor_gl_4k.exr"],
        {
            "brick_wall_001": {C: "brick_wall_001_diffuse_4k.jpg"},
            "brick_wall_003": {C: "brick_wall_003_diffuse_4k.jpg", N: "brick_wall_003_nor_gl_4k.exr"},
        },
    ),
    "ambientCG": (
        ["Bricks076C.png"]
        + [
            f"Bricks076C_1K-JPG_{part}.jpg"
            for part in ("Color", "NormalGL", "NormalDX", "Roughness", "AmbientOcclusion", "Displacement", "Metalness")
        ]
        + ["Bricks076C_1K-JPG_Opacity.jpg", "Bricks076C_1K-JPG_Emission.jpg"],
        {
            "bricks076c": {
                C: "Bricks076C_1K-JPG_Color.jpg",
                N: "Bricks076C_1K-JPG_NormalGL.jpg",
                R: "Bricks076C_1K-JPG_Roughness.jpg",
                M: "Bricks076C_1K-JPG_Metalness.jpg",
            }
        },
    ),
    "Poliigon, old": (
        [f"{FABRIC}_{part}_1K.jpg" for part in ("COL_VAR1", "COL_VAR2", "DISP", "GLOSS", "NRM", "REFL", "AO", "BUMP")]
        + [f"{FABRIC}_OBJECTID_1K.png", f"{FABRIC}_BUMP16_1K.tiff", f"{FABRIC}_NRM16_1K.tiff"],
        {
            f"FabricCanvas001_1k/fabric_canvas001_var{number}": {
                C: f"{FABRIC}_COL_VAR{number}_1K.jpg",
                N: f"{FABRIC}_NRM_1K.jpg",
                R: f"{FABRIC}_GLOSS_1K.jpg",
            }
            for number in (1, 2)
        },
    ),
    "Poliigon, metalness workflow": (
        [f"{SLATE}_{part}_2K_METALNESS.png" for part in ("COL", "NRM", "ROUGHNESS", "METALNESS", "DISP")],
        {
            "tiles_slate_square001": {
                C: f"{SLATE}_COL_2K_METALNESS.png",
                N: f"{SLATE}_NRM_2K_METALNESS.png",
                R: f"{SLATE}_ROUGHNESS_2K_METALNESS.png",
                M: f"{SLATE}_METALNESS_2K_METALNESS.png",
            }
        },
    ),
    "Poliigon, new": (
        [
            f"Poliigon_ConcreteFloorPoured_7656_{part}"
            for part in ("BaseColor.jpg", "Normal.png", "Roughness.jpg", "Metallic.jpg", "ORM.jpg", "Displacement.tiff")
        ],
        {
            "poliigon_concrete_floor_poured": {
                C: "Poliigon_ConcreteFloorPoured_7656_BaseColor.jpg",
                N: "Poliigon_ConcreteFloorPoured_7656_Normal.png",
                R: "Poliigon_ConcreteFloorPoured_7656_Roughness.jpg",
                M: "Poliigon_ConcreteFloorPoured_7656_Metallic.jpg",
            }
        },
    ),
    "Megascans, old": (
        [
            f"vfekbbeqy_2K_{part}.jpg"
            for part in (
                *("Albedo", "Normal", "Normal_LOD0", "Normal_LOD3", "Roughness", "Gloss", "Cavity", "Displacement"),
                *("Specular", "Bump", "AO", "Fuzz", "Translucency"),
            )
        ]
        + ["vfekbbeqy_Preview.png"],
        {
            "vfekbbeqy": {
                C: "vfekbbeqy_2K_Albedo.jpg",
                N: "vfekbbeqy_2K_Normal.jpg",
                R: "vfekbbeqy_2K_Roughness.jpg",
            }
        },
    ),
    "Megascans, levels of detail alone": (
        ["Aset_wood_root_M_rkswd_2K_Albedo.jpg"]
        + [f"Aset_wood_root_M_rkswd_2K_Normal_LOD{level}.jpg" for level in range(3)],
        {
            "aset_wood_root_m_rkswd": {
                C: "Aset_wood_root_M_rkswd_2K_Albedo.jpg",
                N: "Aset_wood_root_M_rkswd_2K_Normal_LOD0.jpg",
            }
        },
    ),
    "Megascans, new": (
        [f"T_uegoehgfw_4K_{part}.png" for part in ("B", "N", "H", "ORM")],
        {"t_uegoehgfw": {C: "T_uegoehgfw_4K_B.png", N: "T_uegoehgfw_4K_N.png"}},
    ),
    "cgbookcase": (
        [f"BigPavingStones03_2K_{part}.png" for part in ("BaseColor", "Normal", "Height", "AO", "Roughness")],
        {
            "big_paving_stones03": {
                C: "BigPavingStones03_2K_BaseColor.png",
                N: "BigPavingStones03_2K_Normal.png",
                R: "BigPavingStones03_2K_Roughness.png",
            }
        },
    ),
    "ShareTextures": (
        [
            f"Fabric_85_{part}-1K.png"
            for part in ("basecolor", "normal", "roughness", "ambientocclusion", "height", "metallic")
        ],
        {
            "fabric_85": {
                C: "Fabric_85_basecolor-1K.png",
                N: "Fabric_85_normal-1K.png",
                R: "Fabric_85_roughness-1K.png",
                M: "Fabric_85_metallic-1K.png",
            }
        },
    ),
    "FreePBR": (
        [
            f"worn-rusted-painted_{part}.png"
            for part in ("albedo", "normal-ogl", "normal-dx", "roughness", "metallic", "ao", "height", "preview")
        ],
        {
            "worn_rusted_painted": {
                C: "worn-rusted-painted_albedo.png",
                N: "worn-rusted-painted_normal-ogl.png",
                R: "worn-rusted-painted_roughness.png",
                M: "worn-rusted-painted_metallic.png",
            }
        },
    ),
    "TextureCan": (
        [
            f"ground_{number}_{part}_1k.jpg"
            for number in ("0027", "0036")
            for part in ("color", "normal_opengl", "normal_directx", "roughness", "ao", "height", "diffuseoriginal")
        ],
        {
            f"ground_{number}": {
                C: f"ground_{number}_color_1k.jpg",
                N: f"ground_{number}_normal_opengl_1k.jpg",
                R: f"ground_{number}_roughness_1k.jpg",
            }
            for number in ("0027", "0036")
        },
    ),
    "GameTextures": (
        [f"WoodBarrel_2k_{part}.jpg" for part in "dsn"],
        {"wood_barrel": {C: "WoodBarrel_2k_d.jpg", N: "WoodBarrel_2k_n.jpg"}},
    ),
    "3DTextures": (
        [f"Stone_Floor_003_{part}.jpg" for part in ("COLOR", "NORM", "ROUGH", "OCC")]
        + ["Stone_Floor_003_DISP.png", "Material_1789.jpg"],
        {
            "stone_floor": {
                C: "Stone_Floor_003_COLOR.jpg",
                N: "Stone_Floor_003_NORM.jpg",
                R: "Stone_Floor_003_ROUGH.jpg",
            }
        },
    ),
    "3DTextures, with spaces": (
        [f"Leather_008_{part}.jpg" for part in ("Base Color", "Normal", "Roughness", "Ambient Occlusion")],
        {
            "leather": {
                C: "Leather_008_Base Color.jpg",
                N: "Leather_008_Normal.jpg",
                R: "Leather_008_Roughness.jpg",
            }
        },
    ),
    "Substance": (
        [f"Oak_{part}.png" for part in ("Base_Color", "Normal_OpenGL", "Normal_DirectX", "Roughness", "Mixed_AO")],
        {"oak": {C: "Oak_Base_Color.png", N: "Oak_Normal_OpenGL.png", R: "Oak_Roughness.png"}},
    ),
    "several resolutions": (
        ["oak_color_1k.png", "oak_color_4k.png", "oak_color_2k.png", "oak_rough_1k.png"],
        {"oak": {C: "oak_color_4k.png", R: "oak_rough_1k.png"}},
    ),
    "colours A and B": (
        ["brick_a_color.png", "brick_b_color.png", "brick_normal.png", "brick_rough.png", "tile_color_A.png"],
        {
            "brick_a": {C: "brick_a_color.png", N: "brick_normal.png", R: "brick_rough.png"},
            "brick_b": {C: "brick_b_color.png", N: "brick_normal.png", R: "brick_rough.png"},
            "tile_color_a": {C: "tile_color_A.png"},
        },
    ),
}


def grouped(names: list[str]) -> tuple[Maps, dict[str, str]]:
    """Group files; return the best file for each map of each texture, and the messages about the others."""
    paths = [Path(name) for name in sorted(names)]
    images = [("" if path.parent == Path() else path.parent.name, path) for path in paths]
    textures, left_out = group_by_texture(images, "folder")
    made = {texture.name: {role: str(files[0].path) for role, files in texture.maps.items()} for texture in textures}
    return made, {str(entry.path): entry.message for entry in left_out}


@pytest.mark.parametrize("library", LIBRARIES)
def test_the_names_of_a_library_are_read(library: str) -> None:
    """Each library's maps come together; variants of a colour share the other maps; the rest is left aside, whole."""
    names, expected = LIBRARIES[library]
    made, left_out = grouped(names)
    assert made == expected
    assert not any("no colour map" in message for message in left_out.values())


@pytest.mark.parametrize(
    ("names", "name"),
    [
        (["wood_table_001_diff_1k.jpg", "wood_table_001_rough_2048.jpg"], "wood_table"),
        (["oak_1000_color.png", "oak_2000_normal.png"], "oak"),
        (["sub/color.png", "sub/normal.png"], "sub"),
        (["sub/Oak_Color.png"], "sub/oak"),
        (["basecolor.png", "4k_normal.png"], "folder"),
        (["rusty_metal_02_diff.png", "rusty_metal_02.png"], "rusty_metal_02"),
        (["Oak_Color.png", "Oak_Metallic.png", "Oak_NormalDX.png", "Oak.png"], "oak"),
    ],
)
def test_a_texture_that_needs_no_telling_apart_keeps_its_name(names: list[str], name: str) -> None:
    """Names of surfaces are part of datasets: sets that former releases read are called as before."""
    assert list(grouped(names)[0]) == [name]


def test_a_single_letter_counts_only_beside_a_normal_map() -> None:
    """Pictures called 'a' and 'b' are no maps."""
    made, left_out = grouped(["oak_color.png", "brick_a.png", "brick_b.png"])
    assert list(made) == ["oak"]
    assert "its name doesn't say what it is for" in left_out["brick_a.png"]


def test_maps_without_a_colour_are_named() -> None:
    """The maps of a texture without colour are left out, each by name."""
    made, left_out = grouped(["oak_color.png", "slate_normal.png", "slate_rough.png"])
    assert list(made) == ["oak"]
    assert sorted(left_out) == ["slate_normal.png", "slate_rough.png"]
    assert "'slate' has no colour map" in left_out["slate_rough.png"]
