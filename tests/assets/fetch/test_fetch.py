"""Putting assets in place, whole or not at all."""

import io
import resource
import tarfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from assets.fetch.download import Patience
from assets.fetch.fetch import Fetcher, Outcome
from assets.fetch.registry import Archive, Asset, AssetFile, Kind, Registry
from assets.files import sha256
from assets.scan.hdris import scan_hdris
from assets.scan.textures import scan_textures
from farm.errors import AssetError
from tests.assets.fetch.download_server import ShelfServer, hdri_asset, panorama, registry_of, shelf_server

SOON = Patience(silence_s=5.0, pauses_s=(0.0,))
MEMBER = "../../package/hall.hdr"


@pytest.fixture
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[ShelfServer]:
    """A server that is reached without a proxy, whatever the environment says."""
    monkeypatch.setenv("no_proxy", "*")
    with shelf_server() as running:
        yield running


@pytest.fixture
def light(tmp_path: Path) -> bytes:
    """The content of an HDRI."""
    return panorama(tmp_path)


def fetch(asset: Asset, root: Path, registry: Registry | None = None) -> Outcome:
    """Fetch one asset."""
    with Fetcher(registry or registry_of(asset), root, patience=SOON) as fetcher:
        return fetcher.fetch(asset)


def files_below(root: Path) -> list[str]:
    """Every file and hidden folder below a folder, by its path."""
    return sorted(str(path.relative_to(root)) for path in root.rglob("*") if path.is_file() or path.name[0] == ".")


def packed(server: ShelfServer, members: dict[str, bytes]) -> Archive:
    """Put an archive on the server."""
    whole = io.BytesIO()
    with tarfile.open(fileobj=whole, mode="w:gz") as tar:
        for name, content in members.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            tar.addfile(entry, io.BytesIO(content))
    data = whole.getvalue()
    return Archive(name="kit-1", url=server.put("/kit-1.tgz", data), sha256=sha256(data), bytes=len(data))


def test_an_hdri_is_put_where_the_farm_can_use_it(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """An HDRI lies under the name that the registry gives it, and nothing else is left."""
    asset = hdri_asset(light, url=server.put("/x/y.hdr?z", light))
    assert fetch(asset, tmp_path / "to") is Outcome.FETCHED
    assert files_below(tmp_path / "to") == ["hdris/hall.hdr"]
    assert [hdri.name for hdri in scan_hdris(tmp_path / "to" / "hdris")] == ["hall"]


def test_what_is_there_is_not_fetched_again(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """A second run asks the server for nothing."""
    asset = hdri_asset(light, url=server.put("/a", light))
    fetch(asset, tmp_path)
    assert fetch(asset, tmp_path) is Outcome.PRESENT
    assert server.asked["/a"] == 1


@pytest.mark.parametrize("damage", [lambda data: data[:-9], lambda data: data[:-1] + b"!"])
def test_what_is_damaged_is_fetched_again(server: ShelfServer, tmp_path: Path, light: bytes, damage: object) -> None:
    """A file cut short, and one of the right size, are made whole."""
    asset = hdri_asset(light, url=server.put("/a", light))
    (tmp_path / "hdris").mkdir()
    (tmp_path / "hdris" / "hall.hdr").write_bytes(damage(light))  # type: ignore[operator]
    assert fetch(asset, tmp_path) is Outcome.FETCHED
    assert (tmp_path / "hdris" / "hall.hdr").read_bytes() == light


def test_a_failure_leaves_nothing(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """A failed fetch leaves neither a part of the file nor a temporary one."""
    asset = hdri_asset(light, url=server.put("/a", light[::-1]))
    with pytest.raises(AssetError, match="has checksum"):
        fetch(asset, tmp_path / "to")
    assert files_below(tmp_path / "to") == []


def test_a_failure_leaves_what_was_there(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """An older file of the same name stays as it was."""
    asset = hdri_asset(light, url=f"{server.url}/gone")
    (tmp_path / "to" / "hdris").mkdir(parents=True)
    (tmp_path / "to" / "hdris" / "hall.hdr").write_bytes(b"older")
    with pytest.raises(AssetError, match="/gone: answered 404"):
        fetch(asset, tmp_path / "to")
    assert (tmp_path / "to" / "hdris" / "hall.hdr").read_bytes() == b"older"
    assert files_below(tmp_path / "to") == ["hdris/hall.hdr"]


def test_what_is_no_image_is_not_kept(server: ShelfServer, tmp_path: Path) -> None:
    """A file that is registered but isn't an image, such as a login page, is not kept."""
    page = b"<html>Please log in</html>"
    asset = hdri_asset(page, url=server.put("/a", page))
    with pytest.raises(AssetError, match=r"^hall\.hdr: came as registered, but .+"):
        fetch(asset, tmp_path / "to")
    assert files_below(tmp_path / "to") == []


def test_several_assets_from_one_archive(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """An archive that several assets share is fetched once and removed in the end; names in it lead nowhere."""
    kit = packed(server, {MEMBER: light, "package/other": b"x"})
    assets = [hdri_asset(light, name, archive="kit-1", member=MEMBER) for name in ("hall", "yard")]
    with Fetcher(Registry(archive=(kit,), asset=tuple(assets)), tmp_path / "deep" / "to", patience=SOON) as fetcher:
        assert [fetcher.fetch(asset) for asset in assets] == [Outcome.FETCHED] * 2
    assert server.asked["/kit-1.tgz"] == 1
    assert files_below(tmp_path) == ["deep/to/hdris/hall.hdr", "deep/to/hdris/yard.hdr"]


def test_a_member_that_differs_is_not_kept(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """A member is checked even if its archive is as registered."""
    kit = packed(server, {MEMBER: light[::-1]})
    asset = hdri_asset(light, archive="kit-1", member=MEMBER)
    with pytest.raises(AssetError, match=r"kit-1\.tgz: .*hall\.hdr has checksum"):
        fetch(asset, tmp_path / "to", Registry(archive=(kit,), asset=(asset,)))
    assert files_below(tmp_path / "to") == []


def test_an_archive_that_differs_is_not_opened(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """An archive whose checksum differs isn't opened."""
    kit = packed(server, {MEMBER: light}).model_copy(update={"sha256": "0" * 64})
    asset = hdri_asset(light, archive="kit-1", member=MEMBER)
    with pytest.raises(AssetError, match=r"kit-1\.tgz: has checksum"):
        fetch(asset, tmp_path / "to", Registry(archive=(kit,), asset=(asset,)))
    assert files_below(tmp_path / "to") == []


def test_the_archive_stands_in_for_a_file_that_is_gone(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """A file whose address is gone is read from the archive; the address is tried first."""
    kit = packed(server, {MEMBER: light})
    asset = hdri_asset(light, url=f"{server.url}/gone", archive="kit-1", member=MEMBER)
    assert fetch(asset, tmp_path, Registry(archive=(kit,), asset=(asset,))) is Outcome.FETCHED
    assert (server.asked["/gone"], server.asked["/kit-1.tgz"]) == (1, 1)


def test_both_failures_are_told(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """If neither the address nor the archive has the file, the error names both failures."""
    kit = packed(server, {})
    asset = hdri_asset(light, url=f"{server.url}/gone", archive="kit-1", member=MEMBER)
    with pytest.raises(AssetError, match=r"/gone: answered 404.*, and .*kit-1\.tgz: holds no"):
        fetch(asset, tmp_path, Registry(archive=(kit,), asset=(asset,)))


def test_a_silent_server_is_asked_once(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """After one silence, the other files come from the archive at once."""
    kit = packed(server, {MEMBER: light})
    assets = []
    for name in ("hall", "yard"):
        server.answers[f"/{name}"] = server.stall(light)
        assets.append(hdri_asset(light, name, url=f"{server.url}/{name}", archive="kit-1", member=MEMBER))
    hasty = Patience(silence_s=0.2, pauses_s=(0.0,))
    with Fetcher(Registry(archive=(kit,), asset=tuple(assets)), tmp_path, patience=hasty) as fetcher:
        assert [fetcher.fetch(asset) for asset in assets] == [Outcome.FETCHED] * 2
    assert (server.asked["/hall"], server.asked["/yard"]) == (1, 0)


def test_a_mirror_is_asked_in_place_of_every_server(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """A mirror's address replaces that of every server."""
    server.put("/mirror/a/b.hdr", light)
    asset = hdri_asset(light, url="https://example.org/a/b.hdr")
    with Fetcher(registry_of(asset), tmp_path, f"{server.url}/mirror/", SOON) as fetcher:
        assert fetcher.fetch(asset) is Outcome.FETCHED


@pytest.mark.parametrize(
    "mirror", ["example.org", "ftp://a.org", "https://", "https://me:secret@a.org", "http://[", "http://a.org:b"]
)
def test_what_is_no_mirror(tmp_path: Path, light: bytes, mirror: str) -> None:
    """A mirror must be an http or https address without a password."""
    with pytest.raises(AssetError, match="--mirror"):
        Fetcher(registry_of(hdri_asset(light, url="https://example.org/a")), tmp_path, mirror)


def texture_asset(server: ShelfServer, folder: Path, roles: list[str]) -> Asset:
    """Put a texture of small maps on the server, without a map called `missing`."""
    files = []
    for role in roles:
        path = folder / f"oak_{role}.png"
        Image.fromarray(np.full((32, 32, 3), len(role), np.uint8)).save(path)
        data = path.read_bytes()
        path.unlink()
        url = server.put(f"/{role}", data)
        files.append(AssetFile(file=f"oak_{role}.png", sha256=sha256(data), bytes=len(data), url=url))
    told = {"licence": "CC0-1.0", "author": "A. Person", "source": "https://example.org"}
    return Asset(name="oak", kind=Kind.TEXTURE, file=tuple(files), **told)


def test_a_texture_is_put_where_the_farm_can_use_it(server: ShelfServer, tmp_path: Path) -> None:
    """All maps of a texture lie in the folder for textures."""
    assert fetch(texture_asset(server, tmp_path, ["color", "normal"]), tmp_path) is Outcome.FETCHED
    (oak,) = scan_textures(tmp_path / "textures")
    assert (oak.name, len(oak.maps)) == ("oak", 2)


def test_half_a_texture_is_not_kept(server: ShelfServer, tmp_path: Path) -> None:
    """If the second map of a texture can't be fetched, the first isn't put in place either."""
    asset = texture_asset(server, tmp_path, ["color", "normal"])
    del server.answers["/normal"]
    with pytest.raises(AssetError, match="/normal: answered 404"):
        fetch(asset, tmp_path / "to")
    assert files_below(tmp_path / "to") == []


def test_only_the_missing_map_is_fetched(server: ShelfServer, tmp_path: Path) -> None:
    """A later run continues where one was interrupted."""
    asset = texture_asset(server, tmp_path, ["color", "normal"])
    fetch(asset, tmp_path)
    (tmp_path / "textures" / "oak_normal.png").unlink()
    assert fetch(asset, tmp_path) is Outcome.FETCHED
    assert (server.asked["/color"], server.asked["/normal"]) == (1, 2)


def test_a_folder_that_can_not_be_made(server: ShelfServer, tmp_path: Path, light: bytes) -> None:
    """The error names a folder that can't be made, and says what to do."""
    (tmp_path / "to").write_text("a file")
    asset = hdri_asset(light, url=server.put("/a", light))
    with pytest.raises(AssetError, match=r"to/hdris: can't be written \(Not a directory\); .*--to"):
        fetch(asset, tmp_path / "to")


@pytest.mark.parametrize("boxed", [False, True])
def test_no_room_leaves_nothing(server: ShelfServer, tmp_path: Path, light: bytes, boxed: bool) -> None:
    """A file or an archive that doesn't fit on the disk leaves nothing behind."""
    kit = packed(server, {MEMBER: light})
    place = {"archive": "kit-1", "member": MEMBER} if boxed else {"url": server.put("/a", light)}
    asset = hdri_asset(light, **place)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limits[1]))
    try:
        with pytest.raises(AssetError, match=r"can't be written \(File too large\)"):
            fetch(asset, tmp_path / "to", Registry(archive=(kit,), asset=(asset,)))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert files_below(tmp_path / "to") == []
