from pathlib import Path

import cv2
import numpy as np
import pytest

from assets.scan.radiance import check_radiance, decode_radiance
from farm.errors import AssetError

FLAT_HEADER = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 6\n"


@pytest.fixture
def whole(tmp_path: Path) -> bytes:
    """A real run-length coded file, 64 by 32 pixels, with runs as well as noise."""
    pixels = np.random.default_rng(0).random((32, 64, 3), np.float32)
    pixels[8:16] = 0.5
    path = tmp_path / "whole.hdr"
    cv2.imwrite(str(path), pixels)
    return path.read_bytes()


def test_pixels_come_back_in_order(tmp_path: Path) -> None:
    """Channels are red, green, blue."""
    path = tmp_path / "red.hdr"
    cv2.imwrite(str(path), np.full((8, 16, 3), (0.125, 0.25, 0.75), np.float32))
    assert np.allclose(decode_radiance(path, path.read_bytes()), (0.75, 0.25, 0.125), atol=0.01)


def test_the_size_is_read_from_the_header(whole: bytes) -> None:
    """The width comes before the height."""
    assert check_radiance(Path("x.hdr"), whole) == (64, 32)


@pytest.mark.parametrize("share", [0.002, 0.005, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999])
def test_the_structure_alone_shows_truncation(whole: bytes, share: float) -> None:
    """A file cut anywhere is refused without being decoded."""
    with pytest.raises(AssetError, match=r"x\.hdr: "):
        check_radiance(Path("x.hdr"), whole[: int(share * len(whole))])


def test_one_missing_byte_shows(whole: bytes) -> None:
    """A file that lacks only its last byte is refused."""
    with pytest.raises(AssetError, match="scan line 31 of 32"):
        check_radiance(Path("x.hdr"), whole[:-1])


def test_uncompressed_files_are_measured() -> None:
    """A narrow picture has no runs, and each pixel takes four bytes."""
    assert check_radiance(Path("x.hdr"), FLAT_HEADER + bytes(96)) == (6, 4)
    with pytest.raises(AssetError, match="truncated: 5 bytes are missing"):
        check_radiance(Path("x.hdr"), FLAT_HEADER + bytes(91))


def test_other_orientations_are_refused() -> None:
    """A file with another order of lines than the usual one is refused."""
    with pytest.raises(AssetError, match="no line like"):
        check_radiance(Path("x.hdr"), FLAT_HEADER.replace(b"-Y", b"+Y") + bytes(96))


def test_another_format_is_refused() -> None:
    """A file that doesn't start like Radiance is refused."""
    with pytest.raises(AssetError, match="isn't a Radiance file"):
        check_radiance(Path("x.hdr"), b"BM" + bytes(100))
