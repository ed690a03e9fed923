"""The options and the file that describe a dataset: nonsense is refused by the name of the option or key."""

from pathlib import Path

import pytest

from farm.errors import AssetError, SpecError, TemplateError
from tests.farm.cli.result import USAGE, Farm, assert_refused


def write_toml(folder: Path, text: str) -> str:
    """Write a description's file."""
    (folder / "cables.toml").write_text(text)
    return "cables.toml"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--quota", "near=3"], ["near", "unknown category", "far_aligned"]),
        (["--quota", "far=-3"], ["far=-3", "whole number"]),
        (["--quota", "far=1.5"], ["far=1.5", "whole number"]),
        (["--quota", "far"], ["CATEGORY=NUMBER"]),
        (["--quota", "far=1", "--quota", "far=2"], ["far", "already"]),
        (["--quota", "far=0"], ["zero images"]),
        (["--images", "0"], ["zero images"]),
        (["--images", "-5"], ["images", "-5"]),
        (["--images", "5", "--quota", "far=1"], ["--images", "--quota"]),
        ([], ["number of images"]),
        (["--images", "1", "--seed", "-1"], ["seed"]),
        (["--images", "1", "--resolution", "3"], ["resolution"]),
        (["--images", "1", "--resolution", "640*480"], ["resolution", "640x480", "not '640*480'"]),
        (["--images", "1", "--close-distributed-hdri", "moon"], ["moon", "there is no HDRI"]),
    ],
)
@pytest.mark.parametrize("command", ["run", "submit"])
def test_bad_flags(farm: Farm, tmp_path: Path, command: str, options: list[str], words: list[str]) -> None:
    """The error names the flag and what is wrong with it."""
    assert_refused(farm(command, *options, "--out", "data"), SpecError.exit_code, *words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "options",
    [
        ["--images", "many"],
        ["--engine", "pencil", "--images", "1"],
        ["--device", "abacus", "--images", "1"],
        ["--what"],
    ],
)
def test_bad_usage(farm: Farm, tmp_path: Path, options: list[str]) -> None:
    """A flag that doesn't exist, or has a value of the wrong type, is wrong usage."""
    assert farm("run", *options, "--out", "data").returncode == USAGE
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("images = ", ["cables.toml", "not valid TOML"]),
        ("images = 3\ncolour = 1", ["cables.toml", "colour", "unknown key"]),
        ("images = 3\n[ranges.cable]\nlenght_m = 1.0", ["ranges.cable.lenght_m", "unknown key"]),
        ("images = 3\n[ranges.cable]\ncount = [5, 2]", ["ranges.cable.count", "above"]),
        ("images = 3\ntextures = 'wood'", ["textures", "list of paths"]),
        ("images = 3\ntemplate = 3", ["template", "path"]),
        ("images = '3'", ["images"]),
        ("[quotas]\nnear = 3", ["near", "unknown category"]),
        ("[quotas]\nfar = 1.5", ["quotas.far"]),
        ("images = 3\nversion = 2", ["version"]),
    ],
)
def test_bad_file(farm: Farm, tmp_path: Path, text: str, words: list[str]) -> None:
    """The error names the file, the key and what is wrong with it."""
    file = write_toml(tmp_path, text)
    assert_refused(farm("run", file, "--out", "data"), SpecError.exit_code, *words)
    assert [path.name for path in tmp_path.iterdir()] == ["cables.toml"]


def test_no_file(farm: Farm) -> None:
    """The error names a description that isn't there."""
    assert_refused(farm("run", "none.toml", "--out", "data"), SpecError.exit_code, "none.toml")


def test_file_and_flags(farm: Farm, tmp_path: Path) -> None:
    """A flag overrides the file's key, and a quota the file's total."""
    file = write_toml(tmp_path, "images = 12\nseed = 3\n")
    result = farm("submit", file, "--quota", "far=0", "--out", "data")
    assert_refused(result, SpecError.exit_code, "cables.toml and flags", "zero images")


@pytest.mark.parametrize(
    ("content", "words"), [(None, ["No such file"]), (b"", [".blend"]), (b"<html>", ["not a .blend file"])]
)
def test_bad_template(farm: Farm, tmp_path: Path, content: bytes | None, words: list[str]) -> None:
    """A template that isn't there, or isn't a .blend file, is refused by its name."""
    inputs = tmp_path / "inputs"
    inputs.mkdir()
    if content is not None:
        (inputs / "mine.blend").write_bytes(content)
    result = farm("run", "--images", "1", "--template", "inputs/mine.blend", "--out", "data")
    assert_refused(result, TemplateError.exit_code, "mine.blend", *words)
    assert [path.name for path in tmp_path.iterdir()] == ["inputs"]


@pytest.mark.parametrize(
    ("flag", "name", "content"),
    [
        ("--textures", "wood_color.png", b"no image"),
        ("--textures", None, b""),
        ("--hdris", "sky.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n\x02\x02"),
        ("--hdris", "sky.exr", b"\x76\x2f\x31\x01"),
        ("--hdris", None, b""),
        ("--backgrounds", "lab.jpg", b"\xff\xd8\xff\xe0"),
        ("--backgrounds", None, b""),
    ],
)
def test_bad_assets(farm: Farm, tmp_path: Path, flag: str, name: str | None, content: bytes) -> None:
    """A texture that isn't an image, a truncated HDRI or photograph and an empty folder are refused by their names."""
    inputs = tmp_path / "inputs"
    inputs.mkdir()
    if name is not None:
        (inputs / name).write_bytes(content)
    result = farm("submit", "--images", "1", flag, "inputs", "--out", "data")
    assert_refused(result, AssetError.exit_code, name or "inputs")
    assert [path.name for path in tmp_path.iterdir()] == ["inputs"]


def test_no_assets_left(farm: Farm) -> None:
    """Leaving the built-in surfaces out without naming others is refused."""
    result = farm("submit", "--images", "1", "--no-builtin-textures", "--out", "data")
    assert_refused(result, AssetError.exit_code, "--textures")
