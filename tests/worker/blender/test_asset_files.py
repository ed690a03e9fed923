"""Asset files, found by the names in scenes."""

from pathlib import Path

import pytest

from assets.environments import EnvironmentKind, EnvironmentRecord, environment_directory
from assets.files import sha256
from assets.surfaces.bake import bake_surfaces
from farm.errors import AssetError
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, FileRef, FolderSurfaceRef, HdriRef, PlateRef
from worker.blender.asset_files import AssetLibrary

SHOWN, OTHER = "stucco", "galvanised_steel"


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two small surfaces, one of them damaged."""
    folder = tmp_path_factory.mktemp("surfaces")
    bake_surfaces(folder, pixels=64, names=[SHOWN, OTHER], processes=1)
    (folder / OTHER / "colour.jpg").write_bytes(b"damaged")
    return folder


def library(header: DatasetHeader, baked: Path, name: str, version: int = 1) -> AssetLibrary:
    """A library of a header that names one surface."""
    surface = BuiltinSurfaceRef(name=name, recipe_version=version)
    return AssetLibrary(header.model_copy(update={"surfaces": (surface,)}), baked)


def test_a_surface_is_found_whatever_the_others_are_like(header: DatasetHeader, baked: Path) -> None:
    """Only the surface that a scene shows is read, so a damaged one beside it does no harm."""
    assert library(header, baked, SHOWN).surface(SHOWN).colour == baked / SHOWN / "colour.jpg"


def test_a_damaged_surface_is_refused(header: DatasetHeader, baked: Path) -> None:
    """A damaged surface is refused when a scene shows it."""
    with pytest.raises(AssetError, match=r"colour\.jpg: differs from its checksum"):
        library(header, baked, OTHER).surface(OTHER)


def test_a_surface_that_is_not_baked_says_what_to_run(header: DatasetHeader, baked: Path) -> None:
    """The error names folder, surface and command."""
    with pytest.raises(AssetError, match=r"the surface 'linen' is not baked here; run `farm assets build`"):
        library(header, baked, "linen").surface("linen")


def test_another_version_of_a_surface_is_refused(header: DatasetHeader, baked: Path) -> None:
    """A surface of another version, whose texels differ from the dataset's, is refused."""
    with pytest.raises(AssetError, match="is of version 1, not 99"):
        library(header, baked, SHOWN, version=99).surface(SHOWN)


@pytest.mark.parametrize("change", [None, b"another"])
def test_a_photograph_is_checked(header: DatasetHeader, tmp_path: Path, change: bytes | None) -> None:
    """A photograph is found by the header; if it has changed or is gone, it is refused."""
    path = tmp_path / "lab.jpg"
    path.write_bytes(b"a photograph")
    plate = PlateRef(name="lab", path=str(path), sha256=sha256(b"a photograph"))
    with_plate = header.model_copy(update={"plates": (plate,)})
    assert AssetLibrary(with_plate, tmp_path).plate("lab") == path
    path.unlink() if change is None else path.write_bytes(change)
    with pytest.raises(AssetError, match=r"lab\.jpg: (can't be read|has changed since)"):
        AssetLibrary(with_plate, tmp_path).plate("lab")


def test_moved_inputs_are_found(header: DatasetHeader, tmp_path: Path) -> None:
    """Photographs, HDRIs, textures and the template are found by content in the folders that the machine has."""
    moved = {name: tmp_path / "here" / name for name in ("lab.jpg", "sky.exr", "oak_color.png", "mine.blend")}
    (tmp_path / "here").mkdir()
    for name, path in moved.items():
        path.write_text(name)
    references = {name: FileRef(path=f"/elsewhere/{name}", sha256=sha256(name.encode())) for name in moved}
    lab, sky, oak, mine = references.values()
    named = header.model_copy(
        update={
            "plates": (PlateRef(name="lab", path=lab.path, sha256=lab.sha256),),
            "hdris": (HdriRef(name="sky", path=sky.path, sha256=sky.sha256, dark=False),),
            "surfaces": (FolderSurfaceRef(name="oak", files={"colour": oak}),),
        }
    )
    here = AssetLibrary(named, tmp_path, [tmp_path / "here"])
    assert here.plate("lab") == moved["lab.jpg"]
    assert here.hdri("sky") == moved["sky.exr"]
    assert here.surface("oak").colour == moved["oak_color.png"]
    assert here.template(Path(mine.path), mine.sha256) == moved["mine.blend"]
    with pytest.raises(AssetError, match=r"oak_color\.png: can't be read .* --inputs"):
        AssetLibrary(named, tmp_path).surface("oak")


def with_environment(header: DatasetHeader, folder: Path, version: int) -> AssetLibrary:
    """A library of a header that names an environment of some version, where version 1 is on disk."""
    directory = environment_directory(folder, "yard_1")
    directory.mkdir(parents=True)
    (directory / "panorama.exr").write_bytes(b"light")
    record = EnvironmentRecord(
        name="yard_1", kind=EnvironmentKind.YARD, version=1, pixels=64, sha256=sha256(b"light"), mean_luminance=0.8
    )
    (directory / "environment.json").write_text(record.model_dump_json())
    hdri = HdriRef(name="yard_1", path=None, dark=False, recipe_version=version)
    return AssetLibrary(header.model_copy(update={"hdris": (hdri,)}), folder)


def test_an_environment_is_found_by_its_name(header: DatasetHeader, tmp_path: Path) -> None:
    """An environment is found beside the surfaces."""
    path = with_environment(header, tmp_path, 1).hdri("yard_1")
    assert path == tmp_path / "environments" / "yard_1" / "panorama.exr"


def test_another_version_of_an_environment_is_refused(header: DatasetHeader, tmp_path: Path) -> None:
    """An environment of another version would show another place, and is refused."""
    with pytest.raises(AssetError, match=r"'yard_1' is of version 1, not 2; run `farm assets build`"):
        with_environment(header, tmp_path, 2).hdri("yard_1")


def test_a_damaged_environment_is_refused(header: DatasetHeader, tmp_path: Path) -> None:
    """A damaged environment is refused when a scene shows it."""
    library = with_environment(header, tmp_path, 1)
    (environment_directory(tmp_path, "yard_1") / "panorama.exr").write_bytes(b"dark")
    with pytest.raises(AssetError, match=r"panorama\.exr: differs from its checksum"):
        library.hdri("yard_1")
