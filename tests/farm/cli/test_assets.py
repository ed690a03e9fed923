"""`farm assets`."""

from pathlib import Path

from PIL import Image

from farm.errors import AssetError, SpecError
from tests.farm.cli.result import Farm, assert_refused


def test_assets_to_check(farm: Farm) -> None:
    """Without a folder there is nothing to check."""
    assert_refused(farm("assets", "check"), SpecError.exit_code, "--textures DIR")


def test_photographs_are_checked(farm: Farm, tmp_path: Path) -> None:
    """Each is told with its size; one that can't be used is refused."""
    Image.new("RGB", (400, 300)).save(tmp_path / "lab.jpg")
    assert farm("assets", "check", "--backgrounds", str(tmp_path)).stdout == "photograph lab: 400 x 300\n"
    Image.new("RGB", (40, 30)).save(tmp_path / "thumb.jpg")
    result = farm("assets", "check", "--backgrounds", str(tmp_path))
    assert_refused(result, AssetError.exit_code, "thumb.jpg", "256 pixels")


def test_assets_are_listed(farm: Farm) -> None:
    """The list has surfaces and HDRIs, and tells which are drawn."""
    result = farm("assets", "list")
    assert result.returncode == 0
    assert "not yet" in result.stdout
    assert "CC0" in result.stdout
