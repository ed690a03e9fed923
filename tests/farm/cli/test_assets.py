"""`farm assets`."""

from farm.errors import SpecError
from tests.farm.cli.result import Farm, assert_refused


def test_assets_to_check(farm: Farm) -> None:
    """Without a folder there is nothing to check."""
    assert_refused(farm("assets", "check"), SpecError.exit_code, "--textures DIR")


def test_assets_are_listed(farm: Farm) -> None:
    """The list has surfaces and HDRIs, and tells which are drawn."""
    result = farm("assets", "list")
    assert result.returncode == 0
    assert "not yet" in result.stdout
    assert "CC0" in result.stdout
