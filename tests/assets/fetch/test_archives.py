"""Reading one file out of an archive, friendly or hostile."""

import io
import tarfile
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assets.fetch.archives import read_member
from farm.errors import AssetError

CONTENT = b"light" * 100
KINDS = ["kit.tgz", "kit.whl"]


def pack(folder: Path, name: str, members: dict[str, bytes]) -> Path:
    """Write an archive of the kind that its name says."""
    path = folder / name
    if name.endswith(".whl"):
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
            for member, content in members.items():
                packed.writestr(member, content)
    else:
        with tarfile.open(path, "w:gz") as tar:
            for member, content in members.items():
                entry = tarfile.TarInfo(member)
                entry.size = len(content)
                tar.addfile(entry, io.BytesIO(content))
    return path


def tar_of(folder: Path, kind: bytes, target: str = "") -> Path:
    """A tar with one entry that isn't a regular file."""
    path = folder / "kit.tgz"
    with tarfile.open(path, "w:gz") as tar:
        entry = tarfile.TarInfo("a/sky.hdr")
        entry.type, entry.linkname = kind, target
        tar.addfile(entry)
    return path


@pytest.mark.parametrize("kind", KINDS)
def test_a_member_is_read(tmp_path: Path, kind: str) -> None:
    """A member is read by its full name, from among others."""
    archive = pack(tmp_path, kind, {"other/sky.hdr": b"dark", "a/sky.hdr": CONTENT})
    assert read_member(archive, kind, "a/sky.hdr", len(CONTENT)) == CONTENT


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["../../escaped.hdr", "/escaped.hdr"])
def test_a_name_that_leads_out_writes_nothing(tmp_path: Path, kind: str, name: str) -> None:
    """A member whose name leads out of the folder is read like any other, and nothing is written to where it leads."""
    home = tmp_path / "deep" / "deeper"
    home.mkdir(parents=True)
    archive = pack(home, kind, {name: CONTENT})
    before = sorted(tmp_path.rglob("*"))
    assert read_member(archive, kind, name, len(CONTENT)) == CONTENT
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(
    ("type_", "target"),
    [
        (tarfile.SYMTYPE, "/etc/hostname"),
        (tarfile.LNKTYPE, "../../etc/hostname"),
        (tarfile.DIRTYPE, ""),
        (tarfile.FIFOTYPE, ""),
        (tarfile.CHRTYPE, ""),
    ],
)
@pytest.mark.parametrize("size", [0, 5])
def test_what_is_no_file_is_refused(tmp_path: Path, type_: bytes, target: str, size: int) -> None:
    """Links, folders, pipes and devices are refused, whatever size was registered."""
    with pytest.raises(AssetError, match=r"kit\.tgz: a/sky\.hdr isn't a file of"):
        read_member(tar_of(tmp_path, type_, target), "kit.tgz", "a/sky.hdr", size)


@pytest.mark.parametrize("kind", KINDS)
def test_a_member_of_another_size_is_refused(tmp_path: Path, kind: str) -> None:
    """A member of another size than registered is refused before it is read."""
    archive = pack(tmp_path, kind, {"a/sky.hdr": CONTENT})
    with pytest.raises(AssetError, match="isn't a file of 7 bytes"):
        read_member(archive, kind, "a/sky.hdr", 7)


@pytest.mark.parametrize("kind", KINDS)
def test_a_member_that_is_missing(tmp_path: Path, kind: str) -> None:
    """The error names a member that is missing."""
    archive = pack(tmp_path, kind, {"a/sky.hdr": CONTENT})
    with pytest.raises(AssetError, match=r"holds no b/sky\.hdr"):
        read_member(archive, kind, "b/sky.hdr", len(CONTENT))


def test_a_zip_that_lies_about_a_size(tmp_path: Path) -> None:
    """A member that unpacks to more than the archive says is refused."""
    path = pack(tmp_path, "kit.whl", {"a/sky.hdr": CONTENT})
    told = len(CONTENT).to_bytes(4, "little")
    path.write_bytes(path.read_bytes().replace(told, (10).to_bytes(4, "little")))
    with pytest.raises(AssetError, match=r"can't be read from it|isn't a file"):
        read_member(path, "kit.whl", "a/sky.hdr", 10)


@settings(max_examples=60)
@given(kind=st.sampled_from(KINDS), place=st.floats(0, 0.999), value=st.integers(1, 255), cut=st.booleans())
def test_damage_is_an_asset_error_or_harmless(
    tmp_path_factory: pytest.TempPathFactory, kind: str, place: float, value: int, cut: bool
) -> None:
    """An archive with a byte changed, or cut short, gives the content or an AssetError, never anything else."""
    path = pack(tmp_path_factory.mktemp("kit"), kind, {"a/sky.hdr": CONTENT})
    data = bytearray(path.read_bytes())
    at = int(place * len(data))
    if cut:
        del data[at:]
    else:
        data[at] ^= value
    path.write_bytes(data)
    with suppress(AssetError):
        assert len(read_member(path, kind, "a/sky.hdr", len(CONTENT))) == len(CONTENT)
