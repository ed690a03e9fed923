"""The one reader of texture maps: what the check of a folder takes, a worker decodes."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import OpenImageIO
import pytest
from numpy.typing import NDArray
from PIL import Image

from assets.scan.texture_image import check_texture, read_texture
from farm.errors import AssetError

Make = Callable[[Path], object]

SMOOTH = cv2.resize(np.random.default_rng(0).integers(0, 255, (4, 4, 3), np.uint8), (64, 48))


def by_pillow(mode: str = "RGB", **options: Any) -> Make:
    """Let Pillow write the smooth picture."""

    def make(path: Path) -> None:
        grey16 = Image.fromarray(SMOOTH[..., 0].astype(np.uint16) * 257)
        image = grey16 if mode == "I;16" else Image.fromarray(SMOOTH).convert(mode)
        image.save(path, **options)

    return make


def by_oiio(pixels: NDArray[Any], tile: int = 0, **attributes: str | int) -> Make:
    """Let OpenImageIO write pixels, (H, W, channels)."""

    def make(path: Path) -> None:
        height, width, channels = pixels.shape
        kinds = {np.uint8: "uint8", np.uint16: "uint16", np.float16: "half", np.float32: "float", np.float64: "double"}
        spec = OpenImageIO.ImageSpec(width, height, channels, kinds[pixels.dtype.type])
        spec.tile_width = spec.tile_height = tile
        for name, value in attributes.items():
            spec.attribute(name.replace("__", ":"), value)
        target = OpenImageIO.ImageOutput.create(str(path))
        assert target.open(str(path), spec)
        assert target.write_image(np.ascontiguousarray(pixels))
        assert target.close()

    return make


DEEP, FLOAT = SMOOTH.astype(np.uint16) * 257, SMOOTH.astype(np.float32) / 255
WITH_ALPHA = np.dstack([SMOOTH, SMOOTH[..., :1]])

FORMATS: dict[str, tuple[str, Make]] = {
    **{
        f"TIFF, {name}": ("tif", by_pillow(compression=name))
        for name in ("raw", "tiff_lzw", "tiff_adobe_deflate", "packbits", "jpeg", "zstd", "lzma")
    },
    **{f"TIFF, {mode}": ("tif", by_pillow(mode)) for mode in ("L", "LA", "RGBA", "P", "1", "CMYK", "I;16", "F", "I")},
    "TIFF, fax": ("tif", by_pillow("1", compression="group4")),
    "TIFF, big": ("tif", by_pillow(big_tiff=True)),
    "TIFF, two pictures": ("tif", by_pillow(save_all=True, append_images=[Image.new("RGB", (8, 8))])),
    "TIFF, 16 bits": ("tif", by_oiio(DEEP)),
    "TIFF, 16 bits with alpha": ("tif", by_oiio(np.dstack([DEEP, DEEP[..., :1]]))),
    **{f"TIFF, {bits} bits": ("tif", by_oiio(DEEP, oiio__BitsPerSample=bits)) for bits in (10, 12)},
    **{f"TIFF, {bits} bits": ("tif", by_oiio(SMOOTH, oiio__BitsPerSample=bits)) for bits in (2, 4)},
    "TIFF, half": ("tif", by_oiio(FLOAT.astype(np.float16))),
    "TIFF, float": ("tif", by_oiio(FLOAT)),
    "TIFF, float, deflate": ("tif", by_oiio(FLOAT, compression="zip")),
    "TIFF, double": ("tif", by_oiio(FLOAT.astype(np.float64))),
    "TIFF, tiles": ("tif", by_oiio(SMOOTH, 32)),
    "TIFF, planes": ("tif", by_oiio(SMOOTH, planarconfig="separate")),
    "TIFF, two channels": ("tif", by_oiio(SMOOTH[..., :2])),
    "TIFF, five channels": ("tif", by_oiio(np.dstack([WITH_ALPHA, SMOOTH[..., :1]]))),
    **{f"PNG, {mode}": ("png", by_pillow(mode)) for mode in ("RGB", "L", "LA", "RGBA", "P", "1", "I;16")},
    "PNG, 16 bits": ("png", by_oiio(DEEP)),
    "PNG, animated": ("png", by_pillow(save_all=True, append_images=[Image.new("RGB", (64, 48))])),
    **{f"JPEG, {mode}": ("jpg", by_pillow(mode)) for mode in ("RGB", "L", "CMYK")},
    "JPEG, progressive": ("jpg", by_pillow(progressive=True)),
    "WebP": ("webp", by_pillow()),
    "WebP, lossless with alpha": ("webp", by_pillow("RGBA", lossless=True)),
    **{f"BMP, {mode}": ("bmp", by_pillow(mode)) for mode in ("RGB", "L", "P", "1", "RGBA")},
    "JPEG 2000": ("jp2", by_pillow()),
    "GIF": ("gif", by_pillow()),
    "AVIF": ("avif", by_pillow()),
    "TGA": ("tga", by_pillow()),
}

REFUSED = {"JPEG 2000", "GIF", "AVIF", "TGA"}
"""Kinds that a check refuses, and whose files a scan passes over for their suffix."""


@pytest.mark.parametrize("name", FORMATS)
def test_what_the_check_takes_can_be_decoded(tmp_path: Path, name: str) -> None:
    """Each kind of file is read by the check and by workers, with its size and its look, or by neither."""
    suffix, make = FORMATS[name]
    path = tmp_path / f"map.{suffix}"
    make(path)
    if name in REFUSED:
        with pytest.raises(AssetError, match="isn't a sound image"):
            check_texture(path, path.read_bytes())
        return
    assert check_texture(path, path.read_bytes()) == (64, 48)
    pixels = read_texture(path)
    assert pixels.shape[:2] == (48, 64)
    if pixels.dtype == np.uint8 and pixels.ndim == 3 and "CMYK" not in name and "LA" not in name:
        coarse = 90 if "2 bits" in name else 24
        assert np.abs(pixels[..., :3].astype(int) - SMOOTH).mean() < coarse


@pytest.mark.parametrize("name", ["TIFF, zstd", "TIFF, 12 bits", "TIFF, 4 bits", "TIFF, five channels"])
@pytest.mark.parametrize("share", [0.02, 0.5, 0.9])
def test_a_file_cut_short_is_refused(tmp_path: Path, name: str, share: float) -> None:
    """A file is refused wherever it is cut, also by the readers of unusual kinds."""
    path = tmp_path / "map.tif"
    FORMATS[name][1](path)
    data = path.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(AssetError, match="isn't a sound image"):
        check_texture(path, path.read_bytes())


def test_the_usual_kinds_keep_their_levels(tmp_path: Path) -> None:
    """OpenCV's levels are those of pictures made so far."""
    for suffix in ("jpg", "png", "webp", "tif", "bmp"):
        path = tmp_path / f"map.{suffix}"
        by_pillow()(path)
        assert (read_texture(path)[..., ::-1] == cv2.imread(str(path), cv2.IMREAD_UNCHANGED)).all()


def test_the_readers_are_quiet(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The codecs' own warnings do not reach a user's terminal."""
    path = tmp_path / "map.tif"
    by_pillow(compression="zstd")(path)
    check_texture(path, path.read_bytes())
    assert capfd.readouterr().err == ""
