"""Registries of assets that can be fetched."""

import json
from pathlib import Path
from typing import Any

import pytest

from assets.fetch.registry import Kind, own_registry, read_registry
from farm.errors import AssetError

SHA = "0" * 64


def archive(**changes: Any) -> dict[str, Any]:
    """The table of an archive."""
    return {"name": "kit-1", "url": "https://example.org/kit-1.tgz", "sha256": SHA, "bytes": 10, **changes}


def file(**changes: Any) -> dict[str, Any]:
    """The table of a file."""
    return {"file": "hall.hdr", "sha256": SHA, "bytes": 5, "url": "https://example.org/hall.hdr", **changes}


def asset(*files: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """The table of an asset."""
    told = {"name": "hall", "kind": "hdri", "licence": "CC0-1.0", "author": "A. Person"}
    return {**told, "source": "https://example.org/a/hall", "file": list(files) or [file()], **changes}


def inline(value: Any) -> str:
    """A value as TOML, tables in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {inline(entry)}" for key, entry in value.items()) + "}"
    return f"[{', '.join(map(inline, value))}]" if isinstance(value, list) else json.dumps(value)


def write(folder: Path, **tables: Any) -> Path:
    """Write a registry's file."""
    path = folder / "mine.toml"
    whole = {"asset": [asset()], **tables}
    path.write_text("\n".join(f"{key} = {inline(value)}" for key, value in whole.items()))
    return path


def test_the_farms_own_is_in_order() -> None:
    """Every entry of the farm's own registry is public domain, from Poly Haven, with a checked second source."""
    registry = own_registry()
    assert len(registry.asset) == 9
    for entry in registry.asset:
        assert entry.licence == "CC0-1.0"
        assert entry.source == f"https://polyhaven.com/a/{entry.name}"
        assert all(part.archive == "viser-1.0.0" for part in entry.file)


def test_a_registry_of_ones_own(tmp_path: Path) -> None:
    """A registry may hold both kinds of assets, from addresses and from archives."""
    boxed = {"url": None, "archive": "kit-1", "member": "package/oak"}
    files = [file(file=f"oak_{role}.png", **boxed) for role in ("color", "normal")]
    for entry in files:
        del entry["url"]
    path = write(tmp_path, archive=[archive()], asset=[asset(), asset(*files, name="oak", kind="texture")])
    hall, oak = read_registry(path).asset
    assert (hall.kind, oak.kind) == (Kind.HDRI, Kind.TEXTURE)
    assert [part.file for part in oak.file] == ["oak_color.png", "oak_normal.png"]


def test_assets_are_found_by_name(tmp_path: Path) -> None:
    """Assets come in the registry's order; no name means all, and an unknown name is told the known ones."""
    files = [file(file=f"{name}.hdr") for name in "abc"]
    registry = read_registry(write(tmp_path, asset=[asset(part, name=part["file"][0]) for part in files]))
    assert [entry.name for entry in registry.find(["c", "a"])] == ["a", "c"]
    assert len(registry.find([])) == 3
    with pytest.raises(AssetError, match="d: no such asset is registered; there are a, b, c"):
        registry.find(["a", "d"])


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"asset": [asset(file(sha256="abc"))]}, r"asset\.0\.file\.0\.sha256: "),
        ({"asset": [asset({"file": "hall.hdr", "bytes": 5, "url": "https://a.org/b"})]}, r"sha256: Field required"),
        ({"asset": [asset(file(bytes=0))]}, r"bytes: "),
        ({"asset": [asset(file(bytes=2**30))]}, r"bytes: "),
        ({"asset": [asset(file(file="../hall.hdr"))]}, r"file\.0\.file: "),
        ({"asset": [asset(file(file=".hall.hdr"))]}, r"file\.0\.file: "),
        ({"asset": [asset(file(file="hall.jpg"))]}, r"an HDRI is one file, \.hdr or \.exr"),
        ({"asset": [asset(file(), file(file="hall2.hdr"))]}, r"an HDRI is one file"),
        ({"asset": [asset(kind="model")]}, r"kind: "),
        ({"asset": [asset(file(url="http://example.org/hall.hdr"))]}, r"must begin with https://"),
        ({"asset": [asset(file(url="file:///etc/passwd"))]}, r"must begin with https://"),
        ({"asset": [asset(file(url="https://me:secret@example.org/a"))]}, r"isn't the plain address"),
        ({"asset": [asset(file(url="https:///a"))]}, r"isn't the plain address"),
        ({"asset": [asset(file(url="https://example.org:none/a"))]}, r"file\.0\.url: "),
        ({"asset": [asset(file(url="https://[::1/a"))]}, r"file\.0\.url: "),
        ({"asset": [asset(file(archive="kit-1"))]}, r"archive and member go together"),
        ({"asset": [asset(file(archive="kit-2", member="a"))]}, r"there is no archive 'kit-2'"),
        ({"asset": [asset({"file": "hall.hdr", "bytes": 5, "sha256": SHA})]}, r"give a url, or an archive"),
        ({"asset": [asset(), asset()]}, r"the asset 'hall' is there twice"),
        ({"asset": [asset(), asset(file(file="Hall.hdr"), name="b")]}, r"the file 'hdris/hall\.hdr' is there twice"),
        ({"archive": [archive(), archive()]}, r"the archive 'kit-1' is there twice"),
        ({"archive": [archive(url="https://example.org/kit-1.rar")]}, r"must end in one of \.tgz"),
        ({"asset": [asset(file(file="oak_color.gif"), kind="texture")]}, r"isn't a kind of image"),
        ({"asset": [asset(file(file="oak_normal.png"), kind="texture")]}, r"one of them '_color'"),
        ({"asset": [asset(file(file="oak_color.png"), file(file="oak_diff.png"), kind="texture")]}, r"tell its maps"),
        ({"asset": [asset(file(file="oak.png"), kind="texture")]}, r"must tell its maps apart"),
        ({"asset": [asset(colour="red")]}, r"colour: Extra inputs"),
        ({"asset": []}, r"asset: "),
    ],
)
def test_wrong_entries_are_refused(tmp_path: Path, tables: dict[str, Any], message: str) -> None:
    """A wrong entry is refused in one line that names file and key."""
    path = write(tmp_path, archive=tables.pop("archive", [archive()]), **tables)
    with pytest.raises(AssetError, match=message) as told:
        read_registry(path)
    assert str(told.value).startswith(f"{path}: ")
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("content", [b"[[asset", b"\xff\xfe", b"a = " + b"1" * 5000, b"a = " + b"[" * 5000, None])
def test_what_is_no_registry(tmp_path: Path, content: bytes | None) -> None:
    """A file that is missing, isn't text or isn't TOML is refused."""
    path = tmp_path / "mine.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(AssetError, match=r"mine\.toml: (isn't TOML|can't be read)"):
        read_registry(path)


def test_this_machine_may_be_asked_by_http(tmp_path: Path) -> None:
    """An http address is allowed on this machine, as for a server that is reached through a tunnel."""
    path = write(tmp_path, asset=[asset(file(url="http://localhost:8000/hall.hdr"))])
    assert read_registry(path).asset[0].file[0].url == "http://localhost:8000/hall.hdr"
