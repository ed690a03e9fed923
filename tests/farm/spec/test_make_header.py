"""Making a header from inputs."""

from collections.abc import Sequence
from pathlib import Path

import pytest
from pydantic import ValidationError

from assets.environments import ENVIRONMENTS
from farm.cli.installed_assets import InstalledAssets
from farm.dataset.header_comparison import difference
from farm.dataset.header_file import header_content, parse_header
from farm.errors import AssetError, SpecError, TemplateError
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.header import BuiltinSurfaceRef, HdriRef, PlateRef, SurfaceRef
from farm.spec.make_header import Inputs, make_header
from farm.spec.parse import describe, parse_spec
from farm.spec.styles import Style

SHA = "0" * 64


class Shelf:
    """Implements `farm.spec.make_header.AssetSource` with names instead of files."""

    def builtin_surfaces(self, _style: Style) -> Sequence[SurfaceRef]:
        """One built-in surface."""
        return [BuiltinSurfaceRef(name="oak", recipe_version=1)]

    def surfaces_in(self, folder: Path) -> Sequence[SurfaceRef]:
        """A surface called as its folder."""
        return [BuiltinSurfaceRef(name=folder.name, recipe_version=1)]

    def builtin_hdris(self) -> Sequence[HdriRef]:
        """One of Blender's HDRIs."""
        return [HdriRef(name="city", path=None, sha256=SHA, dark=False)]

    def environments(self) -> Sequence[HdriRef]:
        """One environment."""
        return [HdriRef(name="workshop", path=None, dark=False, recipe_version=1)]

    def hdris_in(self, folder: Path) -> Sequence[HdriRef]:
        """An HDRI called as its folder."""
        return [HdriRef(name=folder.name, path=str(folder), sha256=SHA, dark=True)]

    def plates_in(self, folder: Path) -> Sequence[PlateRef]:
        """A photograph called as its folder."""
        return [PlateRef(name=folder.name, path=str(folder), sha256=SHA)]


@pytest.fixture
def template(tmp_path: Path) -> Path:
    """A file that begins like a .blend file."""
    path = tmp_path / "mine.blend"
    path.write_bytes(b"BLENDER-v405")
    return path


@pytest.fixture
def spec() -> DatasetSpec:
    """A description of one image."""
    return parse_spec({"images": 1, "style": "published"}, source="test")


def test_folders_add_to_the_builtin(spec: DatasetSpec, template: Path) -> None:
    """The user's folders come after the built-in assets."""
    inputs = Inputs(template, (Path("a"), Path("b")), (Path("sky"),), environments=False)
    header = make_header(spec, inputs, Shelf())
    assert [surface.name for surface in header.surfaces] == ["oak", "a", "b"]
    assert [hdri.name for hdri in header.hdris] == ["city", "sky"]


def test_folders_replace_the_builtin(spec: DatasetSpec, template: Path) -> None:
    """The built-in assets can be left out."""
    inputs = Inputs(
        template, (Path("a"),), (Path("sky"),), builtin_textures=False, builtin_hdris=False, environments=False
    )
    header = make_header(spec, inputs, Shelf())
    assert [surface.name for surface in header.surfaces] == ["a"]
    assert [hdri.name for hdri in header.hdris] == ["sky"]


def test_photographs_are_all_the_users(spec: DatasetSpec, template: Path) -> None:
    """There are no photographs unless folders are named; they come in the folders' order."""
    assert make_header(spec, Inputs(template), Shelf()).plates == ()
    header = make_header(spec, Inputs(template, backgrounds=(Path("lab"), Path("hall"))), Shelf())
    assert [plate.name for plate in header.plates] == ["lab", "hall"]


def test_photographs_decide_the_pictures(spec: DatasetSpec, template: Path) -> None:
    """Other photographs make another dataset."""
    without = make_header(spec, Inputs(template), Shelf())
    with_one = make_header(spec, Inputs(template, backgrounds=(Path("lab"),)), Shelf())
    assert difference(parse_header(header_content(without)), with_one)


def test_one_photograph_twice(spec: DatasetSpec, template: Path) -> None:
    """Two photographs of one name, from two folders, are refused."""
    with pytest.raises(AssetError, match="2 photographs are called 'lab'; rename one"):
        make_header(spec, Inputs(template, backgrounds=(Path("a/lab"), Path("b/lab"))), Shelf())


def test_environments_take_part_unless_they_are_left_out(spec: DatasetSpec, template: Path) -> None:
    """Environments come after Blender's HDRIs, unless they are left out."""

    def names(*, environments: bool) -> list[str]:
        header = make_header(spec, Inputs(template, environments=environments), Shelf())
        return [hdri.name for hdri in header.hdris]

    assert names(environments=True) == ["city", "workshop"]
    assert names(environments=False) == ["city"]


def test_environments_of_this_program() -> None:
    """All registered environments are named, each by its version, since another machine renders other bytes."""
    references = InstalledAssets().environments()
    assert {hdri.name: hdri.recipe_version for hdri in references} == {
        name: recipe.version for name, recipe in ENVIRONMENTS.items()
    }
    assert {hdri.sha256 for hdri in references} == {None}


def test_an_environment_is_none_of_blenders_own(spec: DatasetSpec, template: Path) -> None:
    """Names are unique among all installed HDRIs and environments."""
    names = [hdri.name for hdri in make_header(spec, Inputs(template, environments=True), InstalledAssets()).hdris]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize(
    "fields",
    [
        {"path": None},
        {"path": None, "sha256": SHA, "recipe_version": 1},
        {"path": "/room.exr", "recipe_version": 1},
        {"path": None, "recipe_version": 0},
    ],
)
def test_an_hdri_is_either_a_file_or_an_environment(fields: dict[str, object]) -> None:
    """A file has a checksum; an environment has a version and no path."""
    with pytest.raises(ValidationError):
        HdriRef.model_validate({"name": "room", "dark": False, **fields})


def test_one_name_twice(spec: DatasetSpec, template: Path) -> None:
    """Two assets of one name, which a scene couldn't tell apart, are refused."""
    with pytest.raises(AssetError, match="'oak'"):
        make_header(spec, Inputs(template, (Path("oak"),)), Shelf())


def test_content_of_the_template_counts(spec: DatasetSpec, template: Path) -> None:
    """A template with other content makes another dataset."""
    before = make_header(spec, Inputs(template), Shelf())
    template.write_bytes(b"BLENDER-v406")
    after = make_header(spec, Inputs(template), Shelf())
    assert before.template.path == after.template.path == str(template)
    assert difference(parse_header(header_content(before)), after)


def test_template_that_is_a_folder(spec: DatasetSpec, tmp_path: Path) -> None:
    """A folder is no template."""
    with pytest.raises(TemplateError, match="directory"):
        make_header(spec, Inputs(tmp_path), Shelf())


def test_paths_in_a_file_are_relative_to_it(tmp_path: Path) -> None:
    """Paths in a description count from its file, so it can be used from any folder."""
    file = tmp_path / "cables.toml"
    file.write_text(
        'images = 3\ntemplate = "mine.blend"\ntextures = ["wood"]\nhdris = ["/sky"]\nbuiltin_hdris = false\n'
        'backgrounds = ["photos", "/more"]'
    )
    inputs = describe(file, {}, {}).inputs
    photographs = (tmp_path / "photos", Path("/more"))
    assert inputs == Inputs(
        tmp_path / "mine.blend", (tmp_path / "wood",), (Path("/sky"),), builtin_hdris=False, backgrounds=photographs
    )


def test_flags_override_the_file(tmp_path: Path) -> None:
    """A flag overrides the file's key; the others stay."""
    file = tmp_path / "cables.toml"
    file.write_text('images = 3\nseed = 4\nresolution = 64\ntemplate = "mine.blend"')
    found = describe(file, {"seed": 5, "quotas": {"far": 2}}, {"template": Path("yours.blend")})
    assert (found.spec.seed, found.spec.resolution, found.spec.total) == (5, 64, 2)
    assert found.inputs.template == Path("yours.blend")


def test_ranges_from_a_file(tmp_path: Path) -> None:
    """Every range can be set in its own table."""
    file = tmp_path / "cables.toml"
    file.write_text("images = 3\n[ranges.cable]\ncount = [2, 3]\n[fall.cloth]\nquality = 5")
    spec = describe(file, {}, {}).spec
    assert spec.ranges.cable.count == (2, 3)
    assert spec.fall.cloth.quality == 5


def test_hdri_over_the_floor_must_be_there(template: Path) -> None:
    """The HDRI that a description names must be one of the dataset's."""
    spec = parse_spec({"images": 1, "close_distributed_hdri": "moon"}, source="test")
    with pytest.raises(SpecError, match="there are city"):
        make_header(spec, Inputs(template), Shelf())


def test_a_category_that_makes_no_picture_may_be_beyond_its_budget(template: Path) -> None:
    """The header does not say how it is rendered, as no settings of it are so good."""
    spec = parse_spec({"quotas": {"far": 1}, "quality": 0.015}, source="test")
    rendering = make_header(spec, Inputs(template), Shelf()).rendering
    assert Category.FAR in rendering
    assert Category.CLOSE_CONCENTRATED not in rendering
