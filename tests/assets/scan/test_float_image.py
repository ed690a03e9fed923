import importlib.util
import os
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenImageIO
import pytest
from numpy.typing import NDArray

from assets.scan.float_image import LARGEST_HEADER, read_float_image, write_float_image
from assets.scan.hdris import world_directory
from farm.errors import AssetError
from tests.assets.scan.float_files import exr_header, write_image

needs_bpy = pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="bpy isn't installed")

COMPRESSIONS = ["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"]
LOSSLESS = COMPRESSIONS[:5]
SHARES = [0.0005, 0.003, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999]
MISSING = [1, 2, 9]
RADIANCE_START = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
FLAT = RADIANCE_START + b"-Y 4 +X 6\n"
"""Start of a Radiance file that is too narrow for runs: 96 bytes of pixels follow."""


def noise(height: int = 40, width: int = 72, channels: int = 3) -> NDArray[np.float32]:
    """Noise with even rows in it, which compress to runs."""
    pixels = np.random.default_rng(0).random((height, width, channels), np.float32)
    pixels[height // 4 : height // 2] = 0.5
    return pixels


def cuts(data: bytes) -> set[int]:
    """Lengths at which a file is cut."""
    return {int(share * len(data)) for share in SHARES} | {len(data) - missing for missing in MISSING}


def refusal(path: Path, data: bytes) -> str:
    """The message with which a file of this content is refused."""
    path.write_bytes(data)
    with pytest.raises(AssetError) as refused:
        read_float_image(path)
    message = str(refused.value)
    assert message.startswith(f"{AssetError(str(path))}: ")
    assert "\n" not in message
    return message


@pytest.mark.parametrize("tile", [0, 32])
@pytest.mark.parametrize("compression", LOSSLESS)
def test_lossless_exr_files_come_back_as_written(tmp_path: Path, compression: str, tile: int) -> None:
    """Every value, in the order red, green, blue, the top row first."""
    path = write_image(tmp_path / "a.exr", noise(), compression=compression, tile=tile)
    assert np.array_equal(read_float_image(path), noise())


@pytest.mark.parametrize("suffix", [".hdr", ".HDR"])
def test_radiance_files_come_back_as_written(tmp_path: Path, suffix: str) -> None:
    """To the eight bits that the format has, whatever the case of the suffix."""
    path = write_image(tmp_path / "a.hdr", noise()).rename(tmp_path / f"b{suffix}")
    assert read_float_image(path) == pytest.approx(noise(), abs=1 / 128)


@pytest.mark.parametrize("name", ["what?is=it.exr", "späť.exr", "a b%20#.exr", os.fsdecode(b"\xff.exr")])
def test_a_file_may_have_any_name(tmp_path: Path, name: str) -> None:
    """Signs that have a meaning in an address, and bytes that are no text."""
    path = write_image(tmp_path / "a.exr", noise()).rename(tmp_path / name)
    assert np.array_equal(read_float_image(path), noise())


@pytest.mark.parametrize(
    ("names", "channels"),
    [("RGB", [0, 1, 2]), ("BGR", [2, 1, 0]), ("RGBAZ", [0, 1, 2]), ("Y", [0] * 3), ("YA", [0] * 3)],
)
def test_colours_are_found_by_name(tmp_path: Path, names: str, channels: list[int]) -> None:
    """Red, green and blue in any order and beside others, or the one channel of a grey file three times."""
    pixels = noise(channels=len(names))
    path = write_image(tmp_path / "a.exr", pixels, names=names)
    assert np.array_equal(read_float_image(path), pixels[..., channels])


@pytest.mark.parametrize("names", ["RG", "XYZ", "RA"])
def test_other_channels_are_refused(tmp_path: Path, names: str) -> None:
    """Nothing is guessed."""
    data = write_image(tmp_path / "a.exr", noise(channels=len(names)), names=names).read_bytes()
    assert "export it with R, G and B" in refusal(tmp_path / "a.exr", data)


def test_channel_names_that_are_no_text_are_refused(tmp_path: Path) -> None:
    """As other channels are."""
    data = exr_header(64, 32, channels=4).replace(b"c0\0", b"\xd2\xff\0")
    assert "whose name is no text" in refusal(tmp_path / "a.exr", data)


@pytest.mark.parametrize("length", [1000, -1])
def test_truncated_files_whose_names_are_no_text_are_refused(tmp_path: Path, length: int) -> None:
    """The library's message may quote the name."""
    data = write_image(tmp_path / "a.exr", noise()).read_bytes()
    refusal(tmp_path / os.fsdecode(b"\xff.exr"), data[:length])


@pytest.mark.parametrize("kind", ["float", "half"])
@pytest.mark.parametrize("tile", [0, 32])
@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_truncated_exr_files_are_refused(tmp_path: Path, compression: str, tile: int, kind: str) -> None:
    """Cut anywhere, were it the last byte alone."""
    path = write_image(tmp_path / "a.exr", noise(), compression=compression, tile=tile, kind=kind)
    data = path.read_bytes()
    for length in cuts(data):
        refusal(path, data[:length])


@needs_bpy
def test_truncated_files_of_blender_are_refused(tmp_path: Path) -> None:
    """Each of its eight, cut anywhere."""
    for path in world_directory().glob("*.exr"):
        data = path.read_bytes()
        for length in cuts(data):
            refusal(tmp_path / path.name, data[:length])


@pytest.mark.parametrize("width", [6, 72])
def test_truncated_radiance_files_are_refused(tmp_path: Path, width: int) -> None:
    """With runs, and too narrow for them."""
    path = write_image(tmp_path / "a.hdr", noise(width=width))
    data = path.read_bytes()
    for length in cuts(data):
        refusal(path, data[:length])


def test_damaged_pixels_are_refused(tmp_path: Path) -> None:
    """Zeros in place of a compressed chunk don't decode."""
    path = write_image(tmp_path / "a.exr", noise())
    data = path.read_bytes()
    middle = len(data) // 2
    assert "truncated or damaged" in refusal(path, data[:middle] + bytes(200) + data[middle + 200 :])


def test_an_error_is_told_once(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """By the exception; what OpenEXR writes to standard error is kept back, what is written afterwards is not."""
    path = write_image(tmp_path / "a.exr", noise())
    refusal(path, path.read_bytes()[:-1])
    print("after", file=sys.stderr, flush=True)
    assert capfd.readouterr() == ("", "after\n")


@pytest.mark.parametrize("suffix", [".exr", ".hdr"])
@pytest.mark.parametrize("content", [b"\x89PNG\r\n\x1a\n" + bytes(100), b"BM" + bytes(100), b"#!/bin/sh\n"])
def test_another_format_is_refused(tmp_path: Path, suffix: str, content: bytes) -> None:
    """What doesn't start as its suffix says is given to no reader."""
    assert "whatever its name says" in refusal(tmp_path / f"a{suffix}", content)


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    """Though the content be right."""
    data = write_image(tmp_path / "a.exr", noise()).read_bytes()
    assert "neither .exr nor .hdr" in refusal(tmp_path / "a.tif", data)


def test_an_exr_file_with_the_suffix_of_radiance_is_refused(tmp_path: Path) -> None:
    """The two formats are not mixed up."""
    data = write_image(tmp_path / "a.exr", noise()).read_bytes()
    assert "isn't a Radiance file" in refusal(tmp_path / "a.hdr", data)


@pytest.mark.parametrize("flag", [0x800, 0x1000])
def test_deep_and_multipart_files_are_refused(tmp_path: Path, flag: int) -> None:
    """The flags in the version say so."""
    assert "multi-part EXR files aren't supported" in refusal(tmp_path / "a.exr", exr_header(64, 32, flags=flag))


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (exr_header(100_000, 100_000), "100000 x 100000 pixels"),
        (exr_header(16_384, 8_192), "16384 x 8192 pixels is more than 64 Mi"),
        (exr_header(100, 100, tile=(2**14, 2**14)), "tiles have 16384 x 16384"),
        (exr_header(100, 100, channels=17), "has 17 channels"),
        (exr_header(100, 100, channels=100_000), "header of more than"),
        (exr_header(100, 100, note=bytes(LARGEST_HEADER)), "header of more than"),
        (exr_header(2**31 - 1, 2**31 - 1), "truncated or damaged"),
        (exr_header(0, 0), "truncated or damaged"),
    ],
)
def test_exr_headers_that_claim_too_much_are_refused(tmp_path: Path, data: bytes, words: str) -> None:
    """Before memory or time is taken for it."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert words in refusal(tmp_path / "a.exr", data)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000


@pytest.mark.parametrize(
    ("size", "words"),
    [
        (b"-Y 100000 +X 100000", "100000 x 100000 pixels is outside"),
        (b"-Y 99999999999 +X 99999999999", "pixels is outside"),
        (b"-Y 8192 +X 16384", "more than 64 Mi"),
        (b"-Y 0 +X 6", "6 x 0 pixels is outside"),
        (b"-Y -4 +X -6", "pixels is outside"),
        (b"-Y 1 +X 70000", "70000 x 1 pixels is outside"),
    ],
)
def test_radiance_headers_that_claim_too_much_are_refused(tmp_path: Path, size: bytes, words: str) -> None:
    """Before memory is taken for it."""
    assert words in refusal(tmp_path / "a.hdr", RADIANCE_START + size + b"\n" + bytes(1024))


def test_narrow_radiance_files_are_read(tmp_path: Path) -> None:
    """Below eight pixels there are no runs: each pixel has four bytes, and none may be missing."""
    path = tmp_path / "a.hdr"
    path.write_bytes(FLAT + bytes(96))
    assert np.array_equal(read_float_image(path), np.zeros((4, 6, 3)))
    assert "truncated" in refusal(path, FLAT + bytes(95))


@pytest.mark.parametrize("size", [b"+Y 4 +X 6", b"-Y 4 -X 6", b"+Y 4 -X 6", b"-X 6 +Y 4"])
def test_other_orientations_are_refused(tmp_path: Path, size: bytes) -> None:
    """Only the usual order of lines is read."""
    assert "turned or mirrored" in refusal(tmp_path / "a.hdr", RADIANCE_START + size + b"\n" + bytes(96))


@pytest.mark.parametrize("header", [b"#?RADIANCE\n\n", b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n"])
def test_radiance_files_without_rgb_are_refused(tmp_path: Path, header: bytes) -> None:
    """Files that don't say that they hold RGB: Blender can't read them either."""
    assert "FORMAT" in refusal(tmp_path / "a.hdr", header + b"-Y 4 +X 6\n" + bytes(96))


def test_what_is_written_is_the_same_each_time(tmp_path: Path) -> None:
    """The file holds no date."""
    written = []
    for name in ("a.exr", "b.exr"):
        write_float_image(tmp_path / name, noise())
        written.append((tmp_path / name).read_bytes())
    assert written[0] == written[1]
    assert OpenImageIO.ImageInput.open(str(tmp_path / "a.exr")).spec().get_string_attribute("DateTime") == ""
    assert read_float_image(tmp_path / "a.exr") == pytest.approx(noise(), abs=0.05)


def test_a_folder_that_is_not_there_is_an_error(tmp_path: Path) -> None:
    """Told with the file's name and the reason."""
    with pytest.raises(AssetError, match=r"a\.exr: can't be written .*No such file or directory"):
        write_float_image(tmp_path / "gone" / "a.exr", noise())


@pytest.mark.parametrize("short", [1, 10_000])
def test_a_disk_that_fills_up_is_an_error(tmp_path: Path, short: int) -> None:
    """Though the last byte alone finds no room, which shows when the file is closed."""
    path = tmp_path / "a.exr"
    write_float_image(path, noise(200, 400))
    program = (
        "import resource, sys; from pathlib import Path; from assets.scan.float_image import write_float_image\n"
        "from farm.errors import AssetError; from tests.assets.scan.test_float_image import noise\n"
        "limit = int(sys.argv[2]); resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))\n"
        "try: write_float_image(Path(sys.argv[1]), noise(200, 400))\n"
        "except AssetError as error: print(error)\n"
    )
    command = [sys.executable, "-c", program, str(path), str(path.stat().st_size - short)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "make room" in done.stdout


def test_the_library_is_loaded_by_the_first_file_alone() -> None:
    """A process that reads none doesn't pay its time and memory."""
    program = "import sys, assets.scan.hdris, assets.scan.textures, farm.cli; print('OpenImageIO' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
