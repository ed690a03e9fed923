import struct
from pathlib import Path

import cv2
import numpy as np
import pytest

from assets.scan.exr import check_exr, decode_exr
from farm.errors import AssetError


@pytest.fixture
def whole(tmp_path: Path) -> bytes:
    """A real EXR file of noise, 64 by 32 pixels."""
    path = tmp_path / "whole.exr"
    cv2.imwrite(str(path), np.random.default_rng(0).random((32, 64, 3), np.float32))
    return path.read_bytes()


def test_pixels_come_back_in_order(tmp_path: Path) -> None:
    """Channels are red, green, blue."""
    path = tmp_path / "red.exr"
    cv2.imwrite(str(path), np.full((8, 16, 3), (0.1, 0.2, 0.7), np.float32))
    pixels = decode_exr(path, path.read_bytes())
    assert pixels.shape == (8, 16, 3)
    assert np.allclose(pixels, (0.7, 0.2, 0.1), atol=1e-3)


def test_the_size_is_read_from_the_header(whole: bytes) -> None:
    """The width comes before the height."""
    assert check_exr(Path("x.exr"), whole) == (64, 32)


@pytest.mark.parametrize("share", [0.001, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999])
def test_the_structure_alone_shows_truncation(whole: bytes, share: float) -> None:
    """A file cut anywhere is refused without being decoded."""
    with pytest.raises(AssetError, match=r"x\.exr: "):
        check_exr(Path("x.exr"), whole[: int(share * len(whole))])


def test_one_missing_byte_shows(whole: bytes) -> None:
    """A file that lacks only its last byte is refused."""
    with pytest.raises(AssetError, match="a chunk ends 1 bytes after the end"):
        check_exr(Path("x.exr"), whole[:-1])


def test_another_format_is_refused() -> None:
    """A file that doesn't start like EXR is refused."""
    with pytest.raises(AssetError, match="isn't an EXR file"):
        check_exr(Path("x.exr"), b"\x89PNG\r\n\x1a\n" + bytes(100))


def test_multipart_files_are_refused(whole: bytes) -> None:
    """A file whose version has the multipart flag is refused."""
    version = struct.unpack_from("<I", whole, 4)[0] | 0x1000
    with pytest.raises(AssetError, match="multi-part EXR files aren't supported"):
        check_exr(Path("x.exr"), whole[:4] + struct.pack("<I", version) + whole[8:])


def test_damaged_pixels_are_refused(whole: bytes) -> None:
    """A file with noise in place of a compressed chunk is refused."""
    middle = len(whole) // 2
    damaged = whole[:middle] + bytes(200) + whole[middle + 200 :]
    with pytest.raises(AssetError, match=r"can't be decoded|can't decode"):
        decode_exr(Path("x.exr"), damaged)
