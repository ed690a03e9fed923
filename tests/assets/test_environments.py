"""The environments' registry and records."""

import json
from pathlib import Path

import pytest

from assets.environments import (
    ENVIRONMENTS,
    EnvironmentKind,
    EnvironmentRecord,
    chosen_environments,
    environment_directory,
    environment_generator,
    load_environment,
    missing_environments,
)
from assets.files import sha256
from farm.errors import AssetError

NAME = "workshop_1"
CONTENT = b"stands for an EXR file"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with one environment."""
    write(tmp_path)
    return tmp_path


def write(folder: Path, **changed: object) -> Path:
    """Put an environment there with a changed record; returns the record's path."""
    directory = environment_directory(folder, NAME)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "panorama.exr").write_bytes(CONTENT)
    record = EnvironmentRecord(
        name=NAME,
        kind=EnvironmentKind.WORKSHOP,
        version=ENVIRONMENTS[NAME].version,
        pixels=512,
        sha256=sha256(CONTENT),
        mean_luminance=0.8,
    )
    path = directory / "environment.json"
    path.write_text(json.dumps(record.model_dump(mode="json") | changed))
    return path


def test_every_kind_comes_in_two_variants() -> None:
    """There are seven kinds and fourteen environments, each with its own name."""
    assert len(ENVIRONMENTS) == 14
    assert {name: recipe.name for name, recipe in ENVIRONMENTS.items()} == {name: name for name in ENVIRONMENTS}
    for kind in EnvironmentKind:
        assert sorted(recipe.seed % 2 for recipe in ENVIRONMENTS.values() if recipe.kind is kind) == [0, 1]


def test_each_draws_from_its_own_generator() -> None:
    """No two environments share random numbers, and a recipe has the same ones each time."""
    first = {name: float(environment_generator(recipe).random()) for name, recipe in ENVIRONMENTS.items()}
    again = {name: float(environment_generator(recipe).random()) for name, recipe in ENVIRONMENTS.items()}
    assert first == again
    assert len(set(first.values())) == len(first)


def test_a_version_keeps_the_room_and_another_seed_is_another() -> None:
    """A new version keeps the layout of a room, and another seed changes it."""
    recipe = ENVIRONMENTS[NAME]
    newer = recipe.model_copy(update={"version": recipe.version + 1})
    other = recipe.model_copy(update={"seed": recipe.seed + 2})
    assert environment_generator(recipe).random() == environment_generator(newer).random()
    assert environment_generator(recipe).random() != environment_generator(other).random()


def test_an_environment_is_found(folder: Path) -> None:
    """An environment is found by its name, with its record."""
    found = load_environment(folder, NAME)
    assert found.path == folder / "environments" / NAME / "panorama.exr"
    assert found.record.mean_luminance == 0.8


def test_one_that_is_not_rendered_says_what_to_run(folder: Path) -> None:
    """The error names folder, environment and command."""
    with pytest.raises(AssetError, match=r"the environment 'yard_1' is not rendered here; run `farm assets build`"):
        load_environment(folder, "yard_1")


def test_a_changed_panorama_is_refused(folder: Path) -> None:
    """A panorama with another checksum is refused."""
    (environment_directory(folder, NAME) / "panorama.exr").write_bytes(CONTENT + b".")
    with pytest.raises(AssetError, match=r"panorama\.exr: differs from its checksum"):
        load_environment(folder, NAME)


def test_a_missing_panorama_is_refused(folder: Path) -> None:
    """An environment with a record but no panorama is refused."""
    (environment_directory(folder, NAME) / "panorama.exr").unlink()
    with pytest.raises(AssetError, match=r"panorama\.exr: is missing"):
        load_environment(folder, NAME)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"name": "office_1"}, "is about 'office_1', not 'workshop_1'"),
        ({"version": 0}, "version"),
        ({"pixels": 10**6}, "pixels"),
        ({"kind": "cave"}, "kind"),
        ({"mean_luminance": 0.0}, "mean_luminance"),
        ({"sha256": "../x"}, "sha256"),
        ({"more": 1}, "more"),
    ],
)
def test_a_record_that_lies_is_refused(folder: Path, changed: dict[str, object], told: str) -> None:
    """Every field of a record is checked, and the error names the field and the file."""
    write(folder, **changed)
    with pytest.raises(AssetError, match=rf"environment\.json: .*{told}"):
        load_environment(folder, NAME)


@pytest.mark.parametrize("name", ["", ".", "..", "../secret", "a/b", "/etc", "a\0b"])
def test_no_name_leads_out_of_the_folder(folder: Path, name: str) -> None:
    """A name in a header from a stranger leads to no file outside the folder."""
    with pytest.raises(AssetError, match="can't name an environment"):
        load_environment(folder, name)


def test_only_what_is_there_and_current_counts(folder: Path) -> None:
    """A panorama of another size or an older version is rendered again; without a size, any size will do."""
    others = set(ENVIRONMENTS) - {NAME}
    assert {recipe.name for recipe in missing_environments(folder, None)} == others
    assert {recipe.name for recipe in missing_environments(folder, 512)} == others
    assert {recipe.name for recipe in missing_environments(folder, 4096)} == set(ENVIRONMENTS)
    write(folder, version=ENVIRONMENTS[NAME].version + 1)
    assert {recipe.name for recipe in missing_environments(folder, None)} == set(ENVIRONMENTS)


def test_names_keep_the_registrys_order() -> None:
    """Names come in the registry's order, whatever the order in which they are asked for."""
    assert [recipe.name for recipe in chosen_environments(("yard_1", NAME))] == [NAME, "yard_1"]


def test_an_unknown_name_is_refused() -> None:
    """The error lists the known names."""
    with pytest.raises(AssetError, match=r"'cave'; there are workshop_1"):
        chosen_environments(("cave",))
