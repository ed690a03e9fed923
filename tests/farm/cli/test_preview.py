"""`farm preview`."""

import os
from pathlib import Path

import pytest

from farm.errors import DestinationError, SpecError
from farm.spec.category import Category
from tests.farm.cli.result import USAGE, Farm, assert_refused


@pytest.mark.parametrize("out", ["picture.jpg", "nowhere/picture.png"])
def test_preview_that_cannot_be_written(farm: Farm, tmp_path: Path, out: str) -> None:
    """A picture of an unknown format, or in a folder that isn't there, is refused before it is made."""
    result = farm("preview", "--category", "far", "--out", out)
    assert_refused(result, DestinationError.exit_code, out)
    assert list(tmp_path.iterdir()) == []


def test_preview_over_a_folder(farm: Farm, tmp_path: Path) -> None:
    """A picture or mask that would replace a folder is refused before it is made."""
    (tmp_path / "preview-mask.png").mkdir()
    result = farm("preview", "--category", "far")
    assert_refused(result, DestinationError.exit_code, "preview-mask.png", "is a folder")


def test_preview_in_a_folder_without_rights(farm: Farm, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder without write permission is refused before the picture is made."""
    monkeypatch.setattr(os, "access", lambda *_: False)
    assert_refused(farm("preview", "--category", "far"), DestinationError.exit_code, "can't be written")


def test_preview_takes_no_quota(farm: Farm) -> None:
    """A preview is one image, so quotas are refused."""
    result = farm("preview", "--category", "far", "--images", "3")
    assert_refused(result, SpecError.exit_code, "--images")


def test_preview_of_an_unknown_category(farm: Farm) -> None:
    """An unknown category is wrong usage, and the known ones are listed."""
    result = farm("preview", "--category", "near")
    assert result.returncode == USAGE
    assert Category.FAR in result.stderr
