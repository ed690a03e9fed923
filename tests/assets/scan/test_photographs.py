"""Reading the user's own photographs."""

import os
import struct
import zlib
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from assets.files import sha256
from assets.scan.photographs import decode_plate, read_plate, scan_plates, survey_plates
from farm.errors import AssetError

ORIENTATION = 0x0112


def pixels(width: int = 320, height: int = 260) -> NDArray[np.uint8]:
    """A smooth picture whose four corners differ, so that JPEG keeps it and turns show."""
    across, down = np.meshgrid(np.linspace(0, 200, width), np.linspace(0, 200, height))
    levels: NDArray[np.uint8] = np.stack([across, down, np.full_like(across, 40)], axis=-1).astype(np.uint8)
    return levels


def encoded(format_: str, image: Image.Image | None = None, **options: object) -> bytes:
    """The file of an image."""
    buffer = BytesIO()
    (image or Image.fromarray(pixels())).save(buffer, format_, **options)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("suffix", "format_"), [(".jpg", "JPEG"), (".JPEG", "JPEG"), (".png", "PNG"), (".webp", "WEBP"), (".tif", "TIFF")]
)
def test_a_folder_of_photographs_is_read(tmp_path: Path, suffix: str, format_: str) -> None:
    """Every format is read; other files, hidden ones and subfolders are ignored."""
    data = encoded(format_)
    (tmp_path / f"lab{suffix}").write_bytes(data)
    (tmp_path / f".hidden{suffix}").write_bytes(b"")
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / f"sub{suffix}").mkdir()
    (found,) = scan_plates(tmp_path)
    assert (found.name, found.path, found.sha256) == ("lab", tmp_path / f"lab{suffix}", sha256(data))
    assert (found.width, found.height) == (320, 260)


def test_photographs_are_sorted_by_name(tmp_path: Path) -> None:
    """Photographs come in the order of their names, whatever order the disk has."""
    for name in ("c.png", "a.jpg", "b.png"):
        Image.fromarray(pixels()).save(tmp_path / name)
    assert [plate.name for plate in scan_plates(tmp_path)] == ["a", "b", "c"]


def test_pixels_come_as_they_are() -> None:
    """Lossless formats keep every level; grey becomes three equal channels."""
    assert (decode_plate(Path("a.png"), encoded("PNG")) == pixels()).all()
    grey = decode_plate(Path("a.png"), encoded("PNG", Image.fromarray(pixels()[..., 0])))
    assert (grey == pixels()[..., :1]).all()


@pytest.mark.parametrize("format_", ["JPEG", "PNG", "WEBP", "TIFF"])
@pytest.mark.parametrize("orientation", range(1, 9))
def test_photographs_stand_upright(format_: str, orientation: int) -> None:
    """All eight orientations that EXIF 2.32, 4.6.4, defines are turned upright."""
    upright = pixels()
    stored = {
        1: upright,
        2: upright[:, ::-1],
        3: upright[::-1, ::-1],
        4: upright[::-1],
        5: upright.transpose(1, 0, 2),
        6: upright.transpose(1, 0, 2)[::-1],
        7: upright.transpose(1, 0, 2)[::-1, ::-1],
        8: upright.transpose(1, 0, 2)[:, ::-1],
    }[orientation]
    note = Image.Exif()
    note[ORIENTATION] = orientation
    data = encoded(format_, Image.fromarray(np.ascontiguousarray(stored)), exif=note)
    seen = decode_plate(Path("a"), data)
    assert seen.shape == upright.shape
    assert np.abs(seen.astype(int) - upright).max() < 16  # the error of JPEG's and WebP's compression


def test_the_size_is_that_of_the_upright_picture(tmp_path: Path) -> None:
    """A portrait that is stored as a landscape has the size of a portrait."""
    note = Image.Exif()
    note[ORIENTATION] = 6
    (tmp_path / "a.jpg").write_bytes(encoded("JPEG", exif=note))
    found = read_plate(tmp_path / "a.jpg")
    assert (found.width, found.height) == (260, 320)


@pytest.mark.parametrize("format_", ["JPEG", "PNG", "WEBP", "TIFF"])
@pytest.mark.parametrize("share", [0.0, 0.01, 0.3, 0.6, 0.9])
def test_a_file_cut_short_is_refused(format_: str, share: float) -> None:
    """A file is refused wherever it is cut."""
    noise = np.random.default_rng(0).integers(0, 256, (260, 320, 3), np.uint8)
    data = encoded(format_, Image.fromarray(noise))
    with pytest.raises(AssetError, match=r"^lab: isn't a sound photograph \(.*save it again"):
        decode_plate(Path("lab"), data[: int(share * len(data))])


@settings(max_examples=80)
@given(
    format_=st.sampled_from(["JPEG", "PNG", "WEBP", "TIFF"]),
    damage=st.lists(st.tuples(st.floats(0, 0.9999), st.integers(0, 255)), min_size=1, max_size=8),
)
def test_damage_is_an_asset_error_or_harmless(format_: str, damage: list[tuple[float, int]]) -> None:
    """Changed bytes, also in the orientation, raise nothing but an AssetError."""
    note = Image.Exif()
    note[ORIENTATION] = 8
    data = bytearray(encoded(format_, exif=note))
    for place, value in damage:
        data[int(place * len(data))] = value
    try:
        shape = decode_plate(Path("lab"), bytes(data)).shape
    except AssetError:
        return
    assert shape[2] == 3
    assert min(shape[:2]) >= 256


def in_mode(mode: str) -> Image.Image:
    """The smooth picture with another kind of pixels."""
    shown = Image.fromarray(pixels())
    if mode == "I;16":
        return Image.fromarray(pixels()[..., 0].astype(np.uint16) * 257)
    return shown.convert(mode)


@pytest.mark.parametrize(
    ("mode", "format_"),
    [
        *(("RGBA", name) for name in ("PNG", "TIFF", "WEBP")),
        *((mode, "PNG") for mode in ("LA", "P", "1", "I;16")),
        *((mode, "TIFF") for mode in ("LA", "P", "1", "I;16", "CMYK", "YCbCr")),
        ("CMYK", "JPEG"),
    ],
)
def test_other_kinds_of_pixels_are_converted(mode: str, format_: str) -> None:
    """Transparency, palettes, 16 bits and inks become 8 bit RGB that looks the same."""
    seen = decode_plate(Path("lab"), encoded(format_, in_mode(mode))).astype(int)
    assert seen.shape == (260, 320, 3)
    like = {"I;16": pixels()[..., :1], "LA": np.asarray(Image.fromarray(pixels()).convert("L"))[..., None]}
    if mode != "1":
        assert np.abs(seen - like.get(mode, pixels())).mean() < (20 if mode == "P" else 4)


@pytest.mark.parametrize("mode", ["RGBA", "LA", "PA"])
def test_what_is_transparent_stands_before_white(mode: str) -> None:
    """A hidden colour is not shown, half of a level is a mean with white."""
    image = Image.new("RGBA", (300, 300), (200, 200, 200, 0))
    image.paste((100, 100, 100, 128), (0, 0, 150, 300))
    seen = decode_plate(Path("lab"), encoded("TIFF" if mode == "PA" else "PNG", image.convert(mode)))
    assert (seen[:, 150:] == 255).all()
    assert np.abs(seen[:, :150].astype(int) - 177).max() <= 1


@pytest.mark.parametrize("mode", ["F", "I"])
def test_pixels_of_32_bits_are_refused(mode: str) -> None:
    """They have no white that could be known."""
    with pytest.raises(AssetError, match="32 bits a pixel and channel; save it with 8 or 16"):
        decode_plate(Path("lab"), encoded("TIFF", Image.new(mode, (300, 300))))


def test_of_a_moving_picture_the_first_is_taken() -> None:
    """Animated PNG and WebP files are photographs of their first picture."""
    first = Image.fromarray(pixels())
    for format_ in ("PNG", "WEBP"):
        data = encoded(format_, first, save_all=True, append_images=[Image.new("RGB", first.size)], lossless=True)
        assert (decode_plate(Path("lab"), data) == pixels()).all()


def test_a_folder_as_people_have_it(tmp_path: Path) -> None:
    """What can be used is, hidden files and those of other programs are passed over, and the rest is listed at once."""
    good = encoded("JPEG")
    for name in ("lab.jpg", "._lab.jpg", ".DS_Store", "Thumbs.db", "desktop.ini", "new\nline.jpg"):
        (tmp_path / name).write_bytes(good)
    (tmp_path / "cut.jpg").write_bytes(good[: len(good) // 2])
    (tmp_path / "empty.png").write_bytes(b"")
    (tmp_path / "phone.HEIC").write_bytes(b"heic")
    (tmp_path / "moving.gif").write_bytes(encoded("GIF"))
    (tmp_path / "tiny.png").write_bytes(encoded("PNG", Image.new("RGB", (20, 20))))
    (tmp_path / "gone.jpg").symlink_to(tmp_path / "nowhere.jpg")
    (tmp_path / "loop.jpg").symlink_to(tmp_path / "loop.jpg")
    (tmp_path / "more").mkdir()
    odd = tmp_path / os.fsdecode(b"caf\xe9.jpg")
    odd.write_bytes(good)
    survey = survey_plates(tmp_path)
    assert [plate.name for plate in survey.found] == ["lab", "new\nline"]
    assert {entry.path.name: entry.broken for entry in survey.left_out} == {
        **dict.fromkeys(["cut.jpg", "empty.png", "tiny.png", "gone.jpg", "loop.jpg", odd.name], True),
        **dict.fromkeys(["phone.HEIC", "moving.gif", "more"], False),
    }


@pytest.mark.parametrize(("size", "fits"), [((255, 4000), False), ((4000, 255), False), ((256, 256), True)])
def test_small_photographs_are_refused(size: tuple[int, int], fits: bool) -> None:
    """A photograph is refused if its short side is too small."""
    data = encoded("PNG", Image.new("L", size))
    if fits:
        assert decode_plate(Path("lab"), data).shape == (256, 256, 3)
    else:
        with pytest.raises(AssetError, match=f"{size[0]} x {size[1]} is less than 256 pixels"):
            decode_plate(Path("lab"), data)


@pytest.mark.parametrize("size", [(8192, 8193), (100_000, 100_000)])
def test_claims_of_too_many_pixels_are_refused(size: tuple[int, int]) -> None:
    """A photograph is refused by the size in its header, before anything is decoded."""

    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", *size, 8, 2, 0, 0, 0))
    data = b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", zlib.compress(bytes(9))) + chunk(b"IEND", b"")
    with pytest.raises(AssetError, match=r"more than 64 Mi pixels|too many pixels"):
        decode_plate(Path("lab"), data)


def test_what_only_its_name_calls_a_photograph(tmp_path: Path) -> None:
    """A GIF in disguise, which Pillow could read, and text are refused."""
    for data in (encoded("GIF"), b"<svg/>"):
        (tmp_path / "lab.jpg").write_bytes(data)
        with pytest.raises(AssetError, match=r"lab\.jpg: isn't a sound photograph"):
            scan_plates(tmp_path)


def test_two_photographs_of_one_name(tmp_path: Path) -> None:
    """Scenes tell photographs apart by name, so the second is called by its whole file name."""
    Image.fromarray(pixels()).save(tmp_path / "lab.jpg")
    Image.fromarray(pixels()).save(tmp_path / "lab.png")
    assert [plate.name for plate in scan_plates(tmp_path)] == ["lab", "lab.png"]


@pytest.mark.parametrize("made", [True, False])
def test_an_empty_or_missing_folder(tmp_path: Path, made: bool) -> None:
    """A folder that is missing or holds no photograph is refused."""
    folder = tmp_path / "photos"
    if made:
        folder.mkdir()
    with pytest.raises(AssetError, match="holds no photograph" if made else "isn't a folder"):
        scan_plates(folder)
