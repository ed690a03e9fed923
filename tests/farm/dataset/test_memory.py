"""What is remembered of manifests, and the file that keeps it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from farm.dataset import memory as memory_module
from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.memory import FITS, KNOWN, OWN, Memory
from farm.dataset.paths import CACHE_FILE
from farm.errors import DestinationError
from farm.spec.category import Category
from farm.storage import LocalStorage
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset with a saved memory."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    Completion(dataset, save_after=1).audit()
    return dataset


def loaded(dataset: Dataset) -> Memory:
    """The memory as the next command finds it."""
    memory = Memory(dataset)
    memory.load()
    return memory


def remembered(memory: Memory) -> int:
    """The number of manifests that a memory knows."""
    return sum(int(np.count_nonzero(rows["state"] & KNOWN)) for rows in memory.rows.values())


def test_reads_back(made: Dataset) -> None:
    """What was saved is there for the next command, but for the mark that this process has read it itself."""
    first = Completion(made)
    first.audit()
    second = loaded(made)
    for category, rows in second.rows.items():
        fresh = Memory(made)
        fresh.rows[category][:] = rows
        assert (rows["state"] == KNOWN | FITS).all()
        for name in ("bytes", "modified_s", "mark", "sizes"):
            assert (rows[name] == first.memory.rows[category][name]).all()
            assert name == "mark" or (rows[name] > 0).all()
        everybody = np.ones(len(rows), np.bool_)
        assert second.means_s(category, everybody) == first.memory.means_s(category, everybody)
    assert second.means_s(Category.FAR, np.ones(2, np.bool_))["render"] == pytest.approx(0.01)
    assert second.unsaved == 0


def test_blocks(made: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    """A large category is saved in several blocks."""
    monkeypatch.setattr(memory_module, "_BLOCK_ROWS", 1)
    loaded(made).save()
    assert made.storage.read(CACHE_FILE).count(b'"rows":1') == 4
    assert remembered(loaded(made)) == 4


@pytest.mark.parametrize("damage", ["missing", "empty", "cut", "garbage", "another release", "another line"])
def test_damaged_file(made: Dataset, damage: str) -> None:
    """A file that is missing, damaged or of another release costs reads, and nothing else."""
    content = made.storage.read(CACHE_FILE)
    spoilt = {
        "empty": b"",
        "cut": content[: len(content) // 2],
        "garbage": np.random.default_rng(1).bytes(500),
        "another release": content.replace(b'"release":"', b'"release":"9.', 1),
        "another line": b"[" * 20_000 + b"\n" + content,
    }
    if damage == "missing":
        made.storage.remove(CACHE_FILE)
    else:
        made.storage.write(CACHE_FILE, spoilt[damage])
    assert remembered(loaded(made)) in ({0, 2} if damage == "cut" else {0})
    assert len(Completion(made).audit()) == 4


def test_any_flipped_bit(made: Dataset) -> None:
    """Whichever byte is damaged, nothing is raised, and every job is still found done."""
    content = made.storage.read(CACHE_FILE)
    draw = np.random.default_rng(2)
    for _ in range(100):
        spoilt = bytearray(content)
        spoilt[draw.integers(len(spoilt))] ^= 1 << int(draw.integers(8))
        made.storage.write(CACHE_FILE, bytes(spoilt))
        assert remembered(loaded(made)) <= 4
    assert len(Completion(made).audit()) == 4


def test_memory_of_another_dataset(made: Dataset, tmp_path: Path) -> None:
    """The memory of another dataset, or of one with other quotas, is passed over."""
    for number, header in enumerate((stand_in_header(seed=5), stand_in_header(far=1))):
        other = create_dataset(Destination(str(tmp_path), f"other{number}"), header)
        other.storage.write(CACHE_FILE, made.storage.read(CACHE_FILE))
        assert remembered(loaded(other)) == 0


def test_manifest_that_does_not_fit(made: Dataset) -> None:
    """A manifest that does not fit is known to the process that read it, and not saved for the next."""
    made.storage.write("far/manifests/far-000001.json", b"{}")
    completion = Completion(made)
    completion.audit()
    assert completion.memory.rows[Category.FAR]["state"].tolist() == [KNOWN | FITS, KNOWN | OWN]
    completion.memory.save()
    assert remembered(loaded(made)) == 3


def test_manifest_without_time(made: Dataset) -> None:
    """Where a store tells neither time nor tag, a replaced manifest could not be told, so nothing is saved."""
    memory = loaded(made)
    for rows in memory.rows.values():
        rows["modified_s"] = 0
    memory.rows[Category.FAR]["mark"][0] = 5
    memory.save()
    assert remembered(loaded(made)) == 1


def test_dataset_that_may_only_be_read(made: Dataset) -> None:
    """A memory that can't be saved is no error."""

    class ReadOnly(LocalStorage):
        def write_parts(self, path: str, parts: object) -> int:
            raise DestinationError(f"{path}: may not be written: {parts}")

    made.storage.remove(CACHE_FILE)
    dataset = replace(made, storage=ReadOnly(Path(made.storage.location)))
    assert len(Completion(dataset, save_after=1).audit()) == 4
    assert CACHE_FILE not in made.storage.files()


def test_stages_that_differ(made: Dataset) -> None:
    """A stage that some pictures lack is averaged over those that have it."""
    memory = loaded(made)
    memory._add_stage("dream")
    memory.seconds["dream"][Category.FAR][1] = 4.0
    assert memory.means_s(Category.FAR, np.ones(2, np.bool_))["dream"] == 4.0
    assert "dream" not in memory.means_s(Category.FAR, np.array([True, False]))
    memory.save()
    assert loaded(made).seconds["dream"][Category.FAR][1] == 4.0
