import importlib.util
import os
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from assets.files import sha256
from assets.scan.hdris import (
    DARK_BELOW,
    builtin_hdris,
    mean_luminance,
    read_hdri,
    registry,
    scan_hdris,
    survey_hdris,
    world_directory,
)
from farm.errors import AssetError
from tests.assets.scan.float_files import write_image

needs_bpy = pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="bpy isn't installed")


def panorama(path: Path, pixels: npt.NDArray[np.float32] | None = None) -> Path:
    """Write a panorama, by default bright noise of 64 by 32 pixels."""
    shown = np.random.default_rng(0).random((32, 64, 3), np.float32) + 0.2 if pixels is None else pixels
    return write_image(path, shown)


@needs_bpy
def test_the_registry_agrees_with_the_installed_files() -> None:
    """Checksums and measured light of all eight files are as registered, and which may be a backdrop."""
    assert len(registry()) == 8
    for entry in registry():
        measured = read_hdri(world_directory() / entry.file)
        assert measured.sha256 == entry.sha256
        assert measured.mean_luminance == pytest.approx(entry.mean_luminance, abs=1e-4)
        assert measured.dark == entry.dark
        assert measured.backdrop == entry.backdrop


@needs_bpy
def test_the_registry_lists_every_installed_file() -> None:
    """No HDRI of Blender's is left out."""
    assert {path.name for path in world_directory().glob("*.exr")} == {entry.file for entry in registry()}


@needs_bpy
def test_the_licence_note_names_the_registered_sources() -> None:
    """The note beside the files says CC0 and gives the same pages."""
    note = (world_directory() / "license.txt").read_text()
    assert "CC0" in note
    for entry in registry():
        assert entry.licence == "CC0-1.0"
        assert entry.source in note


@needs_bpy
def test_builtin_hdris_come_with_their_paths() -> None:
    """All eight exist; the night is dark, and the studio isn't a backdrop."""
    found = builtin_hdris()
    assert all(entry.path.is_file() for entry in found)
    assert [entry.name for entry in found if entry.dark] == ["night"]
    assert [entry.name for entry in found if not entry.backdrop] == ["studio"]


@needs_bpy
@pytest.mark.parametrize("share", [0.0005, 0.004, 0.02, 0.2, 0.5, 0.8, 0.95, 0.9999])
def test_a_real_file_cut_short_is_refused(tmp_path: Path, share: float) -> None:
    """One of Blender's files is refused if it is cut in the header, in the offset table or among the pixels."""
    data = (world_directory() / "night.exr").read_bytes()
    path = tmp_path / "night.exr"
    path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(AssetError, match=r"night\.exr: "):
        read_hdri(path)


def test_without_bpy_the_error_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine without bpy is told how to install it."""
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    with pytest.raises(AssetError, match="pip install"):
        builtin_hdris()


def test_an_altered_builtin_file_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file whose checksum isn't the registered one is refused."""
    monkeypatch.setattr("assets.scan.hdris.world_directory", lambda: tmp_path)
    panorama(tmp_path / "city.exr")
    with pytest.raises(AssetError, match=r"city\.exr: differs from the registry's checksum"):
        builtin_hdris()


@pytest.mark.parametrize("suffix", [".hdr", ".exr"])
def test_a_folder_of_panoramas_is_read(tmp_path: Path, suffix: str) -> None:
    """Panoramas of both formats are read; other files are ignored."""
    path = panorama(tmp_path / f"hall{suffix}")
    (tmp_path / "license.txt").write_text("CC0")
    (found,) = scan_hdris(tmp_path)
    assert (found.name, found.path, found.sha256) == ("hall", path, sha256(path.read_bytes()))
    assert found.mean_luminance == pytest.approx(0.7, abs=0.03)


@pytest.mark.parametrize(("level", "dark"), [(DARK_BELOW * 0.9, True), (DARK_BELOW * 1.1, False)])
def test_darkness_is_measured(tmp_path: Path, level: float, dark: bool) -> None:
    """A panorama below the threshold counts as dark."""
    found = read_hdri(panorama(tmp_path / "a.exr", np.full((32, 64, 3), level, np.float32)))
    assert found.dark is dark


def test_luminance_is_weighted_by_solid_angle() -> None:
    """A lit equator counts for more than lit poles; a uniform sphere has its own value."""
    uniform = np.full((64, 128, 3), 0.4, np.float32)
    assert mean_luminance(uniform) == pytest.approx(0.4)
    equator, poles = np.zeros_like(uniform), np.zeros_like(uniform)
    equator[24:40] = 1.0
    poles[:8] = poles[-8:] = 1.0
    assert mean_luminance(equator) == pytest.approx(np.sin(np.pi / 8), abs=0.01)
    assert mean_luminance(poles) == pytest.approx(1 - np.cos(np.pi / 8), abs=0.01)


def test_small_negative_values_of_compression_pass(tmp_path: Path) -> None:
    """Lossy compression leaves tiny negative values beside bright lamps."""
    pixels = np.full((32, 64, 3), 0.5, np.float32)
    pixels[3, 3] = -0.001
    assert read_hdri(panorama(tmp_path / "a.exr", pixels)).mean_luminance > 0


@pytest.mark.parametrize(
    ("value", "message"),
    [(-1.0, "holds negative light"), (np.inf, "infinite or undefined"), (np.nan, "infinite or undefined")],
)
def test_values_that_are_no_light_are_refused(tmp_path: Path, value: float, message: str) -> None:
    """A panorama with a single bad pixel is refused."""
    pixels = np.full((32, 64, 3), 0.5, np.float32)
    pixels[3, 3] = value
    with pytest.raises(AssetError, match=message):
        read_hdri(panorama(tmp_path / "a.exr", pixels))


def test_darkness_all_over_is_refused(tmp_path: Path) -> None:
    """A panorama of zeros is refused, as it can't light anything."""
    with pytest.raises(AssetError, match="black all over"):
        read_hdri(panorama(tmp_path / "a.exr", np.zeros((32, 64, 3), np.float32)))


def test_a_square_picture_is_refused(tmp_path: Path) -> None:
    """A picture that isn't twice as wide as high is refused."""
    with pytest.raises(AssetError, match="32 x 32 isn't 2:1"):
        read_hdri(panorama(tmp_path / "a.hdr", np.ones((32, 32, 3), np.float32)))


def test_two_files_of_one_name(tmp_path: Path) -> None:
    """Scenes tell panoramas apart by name, so the second is called by its whole file name."""
    panorama(tmp_path / "hall.exr")
    panorama(tmp_path / "hall.hdr")
    assert [hdri.name for hdri in scan_hdris(tmp_path)] == ["hall", "hall.hdr"]


def test_what_can_not_light_a_scene_is_left_out(tmp_path: Path) -> None:
    """One sound panorama is enough; the others are listed, all at once."""
    panorama(tmp_path / "hall.exr")
    (tmp_path / "cut.hdr").write_bytes(b"#?RADIANCE")
    panorama(tmp_path / "square.hdr", np.ones((32, 32, 3), np.float32))
    (tmp_path / os.fsdecode(b"caf\xe9.exr")).write_bytes((tmp_path / "hall.exr").read_bytes())
    (tmp_path / "preview.jpg").write_bytes(b"")
    survey = survey_hdris(tmp_path)
    assert [hdri.name for hdri in survey.found] == ["hall"]
    assert [(os.fsencode(entry.path.name), entry.broken) for entry in survey.left_out] == [
        (b"caf\xe9.exr", True),
        (b"cut.hdr", True),
        (b"preview.jpg", False),
        (b"square.hdr", True),
    ]


@pytest.mark.parametrize("made", [True, False])
def test_an_empty_or_missing_folder_is_refused(tmp_path: Path, made: bool) -> None:
    """A folder that is missing or holds no panorama is refused."""
    folder = tmp_path / "hdris"
    if made:
        folder.mkdir()
    with pytest.raises(AssetError, match=r"holds no \.hdr|isn't a folder"):
        scan_hdris(folder)
