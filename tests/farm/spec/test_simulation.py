"""Simulators and their settings."""

from pathlib import Path

import pytest

from farm.dataset.dataset import create_dataset, open_dataset
from farm.dataset.destination import Destination
from farm.dataset.paths import HEADER_FILE
from farm.errors import SpecError
from farm.spec.header import DatasetHeader
from farm.spec.parse import parse_spec
from farm.spec.simulation import ClothFall, Fall, RodFall, Simulator


@pytest.mark.parametrize("simulator", Simulator)
def test_every_simulator_has_settings_under_its_name(simulator: Simulator) -> None:
    """A description sets them in the table `fall` of that name."""
    field = next(iter(type(Fall().settings_of(simulator)).model_fields))
    value = getattr(Fall().settings_of(simulator), field) * 2
    spec = parse_spec({"images": 6, "fall": {simulator.value: {field: value}}}, source="test")
    assert getattr(spec.fall.settings_of(simulator), field) == value


def test_each_simulator_gets_its_own_settings() -> None:
    """Not those of another."""
    fall = Fall(rod=RodFall(steps_per_s=500), cloth=ClothFall(quality=20))
    assert fall.settings_of(Simulator.ROD) is fall.rod
    assert fall.settings_of(Simulator.CLOTH) is fall.cloth


def test_the_published_cloth_is_refused_in_a_description() -> None:
    """With the file, the key, the reason and what to ask for instead."""
    with pytest.raises(
        SpecError, match=r"spec\.toml: simulator: 'cloth-published' .*repeats; ask for 'rod' or 'cloth'"
    ):
        parse_spec({"images": 6, "simulator": "cloth-published"}, source="spec.toml")


def test_the_published_cloth_is_refused_in_a_dataset(tmp_path: Path, header: DatasetHeader) -> None:
    """As the description's fault, and not as a damaged header."""
    dataset = create_dataset(Destination(str(tmp_path), "cables"), header)
    content = dataset.storage.read(HEADER_FILE).replace(b'"simulator": "rod"', b'"simulator": "cloth-published"')
    dataset.storage.write(HEADER_FILE, content)
    with pytest.raises(SpecError, match=r"cables/dataset\.json: spec\.simulator: 'cloth-published' .*another --out"):
        open_dataset(Destination(str(tmp_path), "cables"))


def test_an_unknown_simulator_is_refused_with_those_that_there_are() -> None:
    """By the key."""
    with pytest.raises(SpecError, match=r"simulator: .*'rod'.*'cloth'"):
        parse_spec({"images": 6, "simulator": "string"}, source="test")
