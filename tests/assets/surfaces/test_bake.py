import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cv2
import numpy as np
import pytest

from assets.surfaces.bake import BakedSet, bake_surfaces
from assets.surfaces.baked import load_baked, surface_directory
from assets.surfaces.catalogue import SURFACES
from assets.surfaces.recipe import recipe_generator
from farm.errors import AssetError

PLAIN = "stucco"
WITH_METALLIC_MAP = "galvanised_steel"
NAMES = (PLAIN, WITH_METALLIC_MAP)


def bake(directory: Path, pixels: int = 64) -> BakedSet:
    """Bake two small surfaces."""
    return bake_surfaces(directory, pixels=pixels, names=NAMES, processes=1)


def contents(directory: Path) -> dict[str, bytes]:
    """Every file below a folder."""
    return {str(path.relative_to(directory)): path.read_bytes() for path in directory.rglob("*") if path.is_file()}


def test_a_bake_writes_the_maps_and_the_record(tmp_path: Path) -> None:
    """Each surface gets a folder with the maps that it needs, and nothing else is left behind."""
    bake(tmp_path)
    common = {"colour.jpg", "normal.png", "roughness.jpg", "surface.json"}
    assert {path.name for path in (tmp_path / PLAIN).iterdir()} == common
    assert {path.name for path in (tmp_path / WITH_METALLIC_MAP).iterdir()} == {*common, "metallic.jpg"}


def test_the_files_hold_what_the_recipe_drew(tmp_path: Path) -> None:
    """The normal map comes back exactly, the colour within the loss of JPEG, channels in order."""
    bake(tmp_path)
    recipe = SURFACES[PLAIN]
    maps = recipe.build(recipe_generator(recipe), 64)
    normal = cv2.imread(str(tmp_path / PLAIN / "normal.png"))
    colour = cv2.imread(str(tmp_path / PLAIN / "colour.jpg"))
    assert np.array_equal(normal[..., ::-1], maps.normal)
    assert np.abs(colour[..., ::-1].astype(float) - maps.colour).mean() < 4


def test_a_second_bake_draws_nothing(tmp_path: Path) -> None:
    """Whole surfaces of the right version are kept and not even touched."""
    first = bake(tmp_path)
    times = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    second = bake(tmp_path)
    assert set(first.drawn) == set(NAMES)
    assert second.drawn == ()
    assert second.surfaces == first.surfaces
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == times


def test_two_bakes_write_the_same_bytes(tmp_path: Path) -> None:
    """The seed follows from name and version alone, so that simultaneous bakes agree."""
    bake(tmp_path / "a")
    bake(tmp_path / "b")
    assert contents(tmp_path / "a") == contents(tmp_path / "b")


def test_bakes_of_one_folder_at_once_end_whole(tmp_path: Path) -> None:
    """Several bakes that race for the same files leave the same files as one, and no temporary file."""
    bake(tmp_path / "alone")
    with ThreadPoolExecutor(4) as pool:
        for race in [pool.submit(bake, tmp_path / "raced") for _ in range(4)]:
            assert len(race.result().surfaces) == len(NAMES)
    assert contents(tmp_path / "raced") == contents(tmp_path / "alone")


def test_baking_in_processes_gives_the_same_bytes(tmp_path: Path) -> None:
    """Two spawned processes draw what one does, and every name is reported once."""
    told: list[str] = []
    bake(tmp_path / "a")
    bake_surfaces(tmp_path / "b", pixels=64, names=NAMES, processes=2, progress=told.append)
    assert contents(tmp_path / "a") == contents(tmp_path / "b")
    assert sorted(told) == sorted(NAMES)


@pytest.mark.parametrize("victim", ["colour.jpg", "normal.png", "surface.json"])
def test_a_damaged_file_is_repaired(tmp_path: Path, victim: str) -> None:
    """A surface with a truncated file is drawn again; the others stay."""
    bake(tmp_path)
    whole = contents(tmp_path)
    path = tmp_path / PLAIN / victim
    path.write_bytes(path.read_bytes()[:-20])
    assert bake(tmp_path).drawn == (PLAIN,)
    assert contents(tmp_path) == whole


def test_a_missing_file_is_repaired(tmp_path: Path) -> None:
    """A surface that lacks one of its maps is drawn again."""
    bake(tmp_path)
    whole = contents(tmp_path)
    (tmp_path / PLAIN / "roughness.jpg").unlink()
    assert bake(tmp_path).drawn == (PLAIN,)
    assert contents(tmp_path) == whole


def test_another_resolution_is_drawn_afresh(tmp_path: Path) -> None:
    """A surface of another resolution doesn't count as baked."""
    bake(tmp_path)
    again = bake(tmp_path, pixels=80)
    assert set(again.drawn) == set(NAMES)
    assert {surface.record.pixels for surface in again.surfaces} == {80}


def test_another_version_is_drawn_afresh(tmp_path: Path) -> None:
    """A record of another recipe version doesn't count as baked."""
    bake(tmp_path)
    path = tmp_path / PLAIN / "surface.json"
    record = json.loads(path.read_text())
    path.write_text(json.dumps({**record, "recipe_version": record["recipe_version"] + 1}))
    assert bake(tmp_path).drawn == (PLAIN,)


def test_a_record_from_before_joints_is_drawn_afresh(tmp_path: Path) -> None:
    """A record without an entry for joints doesn't count as baked."""
    bake(tmp_path)
    path = tmp_path / PLAIN / "surface.json"
    record = json.loads(path.read_text())
    del record["has_joints"]
    path.write_text(json.dumps(record))
    assert bake(tmp_path).drawn == (PLAIN,)


def test_a_surface_in_pieces_has_a_map_of_its_joints(tmp_path: Path) -> None:
    """A surface that is laid in pieces has the map of joints that its recipe drew."""
    (baked,) = bake_surfaces(tmp_path, pixels=64, names=["brick_wall"], processes=1).surfaces
    recipe = SURFACES["brick_wall"]
    assert baked.record.has_joints
    found = cv2.imread(str(baked.path("joints")), cv2.IMREAD_UNCHANGED)
    drawn = recipe.build(recipe_generator(recipe), 64).joints
    assert drawn is not None
    assert np.array_equal(found, drawn)


def test_loading_finds_what_was_baked(tmp_path: Path) -> None:
    """Loading returns the names, sizes and paths of the baked surfaces."""
    bake(tmp_path)
    loaded = load_baked(tmp_path)
    assert set(loaded) == set(NAMES)
    assert loaded[PLAIN].record.size_m == SURFACES[PLAIN].size_m
    assert loaded[PLAIN].record.metallic == 0.0
    assert loaded[PLAIN].path("colour") == tmp_path / PLAIN / "colour.jpg"
    assert loaded[WITH_METALLIC_MAP].record.metallic is None
    assert loaded[WITH_METALLIC_MAP].path("metallic").is_file()


def test_a_surface_without_metallic_map_says_so(tmp_path: Path) -> None:
    """The error for a metallic map that doesn't exist names the folder."""
    bake(tmp_path)
    with pytest.raises(AssetError, match=f"{PLAIN}: has no metallic map"):
        load_baked(tmp_path)[PLAIN].path("metallic")


def test_loading_an_empty_folder_says_what_to_run(tmp_path: Path) -> None:
    """The error names the command that bakes."""
    with pytest.raises(AssetError, match="run 'farm assets build'"):
        load_baked(tmp_path)


@pytest.mark.parametrize(
    ("key", "value"),
    [("size_m", -1.0), ("pixels", 3), ("family", "cheese"), ("name", "linen"), ("extra", 1), ("sha256", {})],
)
def test_loading_refuses_a_wrong_record(tmp_path: Path, key: str, value: object) -> None:
    """Each wrong or unknown entry of the record is refused with the file's path."""
    bake(tmp_path)
    path = tmp_path / PLAIN / "surface.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), key: value}))
    with pytest.raises(AssetError, match=r"surface\.json: .*run 'farm assets build'"):
        load_baked(tmp_path)


def test_loading_refuses_an_altered_map(tmp_path: Path) -> None:
    """A file that differs from its checksum is named."""
    bake(tmp_path)
    path = tmp_path / PLAIN / "colour.jpg"
    path.write_bytes(path.read_bytes() + b"x")
    with pytest.raises(AssetError, match=r"colour\.jpg: differs from its checksum"):
        load_baked(tmp_path)


def test_an_unknown_name_is_refused(tmp_path: Path) -> None:
    """The error lists the known names."""
    with pytest.raises(AssetError, match=r"unknown surface 'cheese'; there are .*linen"):
        bake_surfaces(tmp_path, names=["linen", "cheese"])


@pytest.mark.parametrize("pixels", [0, 63, 8193])
def test_an_absurd_resolution_is_refused(tmp_path: Path, pixels: int) -> None:
    """A resolution outside 64 to 8192 is refused, and nothing is drawn."""
    with pytest.raises(AssetError, match="outside 64 to 8192"):
        bake_surfaces(tmp_path, pixels=pixels, names=[PLAIN])


def test_a_folder_that_cannot_be_written_is_reported(tmp_path: Path) -> None:
    """If a file stands in the way, the error names the place."""
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(AssetError, match="can't be written"):
        bake_surfaces(tmp_path / "file", pixels=64, names=[PLAIN], processes=1)


def test_the_default_folder_follows_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """The default folder is FARM_ASSETS, else in the user's cache folder, else the usual one."""
    monkeypatch.setenv("FARM_ASSETS", "/data/surfaces")
    monkeypatch.setenv("XDG_CACHE_HOME", "/cache")
    monkeypatch.setenv("HOME", "/home/someone")
    assert surface_directory() == Path("/data/surfaces")
    monkeypatch.delenv("FARM_ASSETS")
    assert surface_directory() == Path("/cache/cable-farm/surfaces")
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert surface_directory() == Path("/home/someone/.cache/cable-farm/surfaces")
