"""Images that claim to be, are or lead to something else are refused after little of them is read."""

import os
import resource
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import pytest

from assets.files import open_regular, read_bounded
from assets.scan.hdris import read_hdri, scan_hdris
from assets.scan.texture_names import TextureRole
from assets.scan.textures import read_map, scan_textures
from farm.errors import AssetError
from farm.spec.header import FileRef
from tests.assets.scan.float_files import exr_header
from worker.blender.asset_files import checked

SIZES = [(100_000, 100_000), (16_384, 16_384)]


def png(width: int, height: int) -> bytes:
    """A PNG whose header claims a size, with a thousand zeros for pixels."""

    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    pixels = zlib.compress(bytes(1000))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


def radiance(width: int, height: int) -> bytes:
    """A black Radiance file that holds what it claims, in runs: 16,384 pixels in a kilobyte."""
    runs = bytes([255, 1]) * (width // 127) + bytes([128 + width % 127, 1])
    line = bytes([2, 2, width >> 8, width & 255]) + 4 * runs
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + line * height


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("suffix", [".png", ".exr"])
def test_a_texture_that_claims_too_many_pixels_is_refused(tmp_path: Path, suffix: str, size: tuple[int, int]) -> None:
    """A texture is refused by the size in its header, and nothing of that size is allocated."""
    path = tmp_path / f"oak_color{suffix}"
    path.write_bytes(png(*size) if suffix == ".png" else exr_header(*size))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(AssetError, match="pixels"):
        scan_textures(tmp_path)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000


def test_a_panorama_that_unfolds_is_refused(tmp_path: Path) -> None:
    """A whole file of eight megabytes that would unpack to six gigabytes is refused."""
    (tmp_path / "night.hdr").write_bytes(radiance(16_384, 8_192))
    with pytest.raises(AssetError, match=r"16384 x 8192 pixels is more than 64 Mi"):
        scan_hdris(tmp_path)


@pytest.mark.parametrize("suffix", [".png", ".jpg", ".exr"])
def test_a_script_named_as_an_image_is_none(tmp_path: Path, suffix: str) -> None:
    """A script with the name of an image is refused: a name doesn't count."""
    path = tmp_path / f"oak_color{suffix}"
    path.write_text("#!/bin/sh\necho hello\n")
    with pytest.raises(AssetError):
        read_map(TextureRole.COLOUR, path)


def test_a_link_leads_to_an_image_or_nowhere(tmp_path: Path) -> None:
    """A link is followed; if it doesn't lead to an image, it is refused without showing the content."""
    (tmp_path / "oak_color.png").symlink_to("/etc/passwd")
    with pytest.raises(AssetError) as refused:
        scan_textures(tmp_path)
    assert "root:" not in str(refused.value)


@pytest.mark.parametrize("name", ["oak_color.png", "night.hdr"])
def test_devices_are_no_assets(tmp_path: Path, name: str) -> None:
    """A device without an end is never read, and a scan ignores it."""
    path = tmp_path / name
    path.symlink_to("/dev/zero")
    with pytest.raises(AssetError, match="regular file"):
        read_map(TextureRole.COLOUR, path) if name.endswith(".png") else read_hdri(path)
    with pytest.raises(AssetError, match="holds no"):
        scan_textures(tmp_path) if name.endswith(".png") else scan_hdris(tmp_path)


def test_pipes_are_no_assets(tmp_path: Path) -> None:
    """A pipe is refused without waiting for a writer."""
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(AssetError, match="regular file"):
        read_bounded(tmp_path / "pipe")
    with pytest.raises(AssetError, match="regular file"):
        open_regular(tmp_path / "pipe")


@pytest.mark.parametrize("path", ["/dev/zero", "/dev/stdin", "/proc/self/mem", "/"])
def test_a_header_that_names_something_else_than_a_file(path: str) -> None:
    """A worker doesn't hang on a device or pipe that a header from a stranger names."""
    program = (
        "from farm.errors import AssetError\nfrom farm.spec.header import FileRef\n"
        "from worker.blender.asset_files import checked\n"
        f"try: checked(FileRef(path={path!r}, sha256='0' * 64))\nexcept AssetError as error: print('refused')\n"
    )
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, stdin=subprocess.PIPE)
    assert done.stdout.strip() == "refused", done.stderr


def test_a_file_with_other_content_than_the_headers_is_refused(tmp_path: Path) -> None:
    """A header can't make a worker open a file whose content its author doesn't know."""
    (tmp_path / "secret").write_text("word")
    with pytest.raises(AssetError, match="changed"):
        checked(FileRef(path=str(tmp_path / "secret"), sha256="0" * 64))
