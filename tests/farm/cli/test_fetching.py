"""`farm assets fetch`."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from assets.files import sha256
from farm.errors import AssetError
from tests.assets.fetch.download_server import ShelfServer, panorama, shelf_server
from tests.farm.cli.result import Farm, assert_refused


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[ShelfServer]:
    """A server that has the HDRI `hall`."""
    monkeypatch.setenv("no_proxy", "*")
    with shelf_server() as running:
        running.put("/hall", panorama(tmp_path))
        yield running


@pytest.fixture
def registry(server: ShelfServer, tmp_path: Path) -> str:
    """A registry with `hall`, and with `yard`, which the server lacks."""
    content = panorama(tmp_path)
    path = tmp_path / "mine.toml"
    path.write_text(
        "\n".join(
            f'[[asset]]\nname = "{name}"\nkind = "hdri"\nlicence = "CC0-1.0"\nauthor = "A. Person"\n'
            f'source = "https://example.org"\n[[asset.file]]\nfile = "{name}.hdr"\nbytes = {len(content)}\n'
            f'sha256 = "{sha256(content)}"\nurl = "{server.url}/{name}"\n'
            for name in ("hall", "yard")
        )
    )
    return str(path)


def test_what_there_is(farm: Farm) -> None:
    """The list doesn't ask the server."""
    result = farm("assets", "fetch", "--list")
    assert result.returncode == 0
    assert "forest_slope" in result.stdout
    assert "CC0" in result.stdout


def test_an_hdri_is_fetched_to_the_cache(farm: Farm, registry: str, tmp_path: Path) -> None:
    """The command names the file and the option for its folder, which `farm assets check` takes, too."""
    result = farm("assets", "fetch", "hall", "--registry", registry)
    assert result.returncode == 0, result.stderr
    folder = tmp_path / "cache" / "cable-farm" / "fetched" / "hdris"
    assert result.stdout.splitlines() == [
        "hall: fetched",
        f"1 HDRI in {folder}; add to a dataset with --hdris {folder}",
    ]
    assert farm("assets", "check", "--hdris", str(folder)).stdout == "HDRI hall: bright\n"
    assert "hall: there already" in farm("assets", "fetch", "hall", "--registry", registry).stdout


def test_one_failure_does_not_keep_the_others(farm: Farm, registry: str, tmp_path: Path) -> None:
    """A failure is reported and decides the exit code, and the other assets are fetched."""
    result = farm("assets", "fetch", "--registry", registry, "--to", "here")
    assert result.returncode == AssetError.exit_code
    assert (tmp_path / "here" / "hdris" / "hall.hdr").is_file()
    first, last = result.stderr.splitlines()
    assert "/yard: answered 404" in first
    assert "1 of 2 could not be fetched (yard)" in last


def test_a_single_failure_is_one_line(farm: Farm, registry: str) -> None:
    """A single failure is one line on standard error, as with every command."""
    result = farm("assets", "fetch", "yard", "--registry", registry)
    assert_refused(result, AssetError.exit_code, "yard: ", "/yard: answered 404", "--mirror")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["moon"], ["moon: no such asset", "forest_slope"]),
        (["--mirror", "example.org"], ["--mirror example.org", "http(s)://"]),
        (["--registry", "none.toml"], ["none.toml", "can't be read"]),
    ],
)
def test_wrong_use_is_refused(farm: Farm, options: list[str], words: list[str]) -> None:
    """Wrong use is refused before the server is asked."""
    assert_refused(farm("assets", "fetch", *options), AssetError.exit_code, *words)
