"""Images per hour from the moments at which pictures were finished, splits, memory, and one run of the real farm."""

import json
import os
from argparse import ArgumentTypeError
from pathlib import Path

import pytest

from benchmarks.farm.command import run
from benchmarks.farm.memory import memory_mib
from benchmarks.farm.play import finished
from benchmarks.farm.rates import Finished, Throughput, best, factors
from benchmarks.farm.report import conclusions, throughput_table, write_json, write_plot
from benchmarks.farm.splits import SPLITS, Split, parse_split
from benchmarks.terminal import bench_console
from farm.dataset.dataset import Dataset
from farm.errors import SpecError
from tests.stand_in import StandInRenderer
from worker.service.upload import upload


def played(split: Split, *after_s: float, opened: int | None = None, wall_s: float = 100.0) -> Throughput:
    """A run whose first pictures, one of each worker, opened the template."""
    first = split.workers if opened is None else opened
    pictures = tuple(Finished(seconds, number < first) for number, seconds in enumerate(after_s))
    return Throughput(split, pictures, wall_s, 1000.0)


def test_the_rate_is_that_of_the_pictures_after_every_workers_first() -> None:
    """Ten seconds pass until both workers work, and then a picture is finished every two seconds."""
    throughput = played(Split(2, 1), 8.0, 10.0, 12.0, 14.0, 16.0)
    assert throughput.first_s == (8.0, 10.0)
    assert throughput.images_per_hour == pytest.approx(1800)
    assert throughput.overall_images_per_hour == pytest.approx(180)
    assert throughput.hours(1800) == pytest.approx(1 + 10 / 3600)


def test_a_process_that_is_replaced_later_is_no_start_up() -> None:
    """Only the first picture of each worker's first process counts as start-up."""
    pictures = tuple(Finished(seconds, seconds in {5.0, 9.0}) for seconds in (5.0, 7.0, 9.0, 11.0))
    assert Throughput(Split(1, 1), pictures, 12.0, None).first_s == (5.0,)


def test_a_run_without_later_pictures_has_the_rate_of_all() -> None:
    """A run with as many pictures as workers has the rate of all its pictures."""
    throughput = played(Split(2, 1), 8.0, 10.0, wall_s=20.0)
    assert throughput.images_per_hour == pytest.approx(360)


def test_factors_are_over_one_worker_with_one_thread() -> None:
    """Without a run of one worker with one thread there are no factors."""
    one = played(Split(1, 1), 4.0, 8.0, 12.0)
    two = played(Split(2, 1), 4.0, 4.0, 6.0, 8.0)
    assert factors([one, two]) == {Split(1, 1): 1.0, Split(2, 1): pytest.approx(2.0)}
    assert factors([two]) == {}
    assert best([one, two]) is two


def test_splits_are_read_as_they_are_written() -> None:
    """WORKERSxTHREADS is read, and nothing else."""
    assert [parse_split(str(split)) for split in SPLITS] == list(SPLITS)
    for text in ("2", "x", "0x1", "1x0", "axb", "1x2x3"):
        with pytest.raises(ArgumentTypeError, match="such as 2x1"):
            parse_split(text)


def test_pictures_are_read_from_the_dataset_in_their_order(dataset: Dataset) -> None:
    """Pictures come in the order in which their manifests were written."""
    jobs = list(dataset.header.spec.jobs())
    for number, job in enumerate(jobs):
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
        for path in Path(dataset.storage.location).rglob(f"manifests/{job.id}.json"):
            os.utime(path, (1000.0 - number, 1000.0 - number))
    found = finished(dataset, 900.0)
    assert [each.after_s for each in found] == pytest.approx([101.0 - len(jobs) + k for k in range(len(jobs))])


def test_memory_is_of_all_descendants(tmp_path: Path) -> None:
    """A process and all its descendants count, and no others; on a system without /proc there is no figure."""
    for number, parent, kib in ((10, 1, 1024), (11, 10, 2048), (12, 11, 4096), (13, 1, 9999)):
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "stat").write_text(f"{number} (a name) S {parent} 0 0")
        (folder / "smaps_rollup").write_text(f"00-ff ---p [rollup]\nRss: 99999 kB\nPss: {kib} kB\n")
    assert memory_mib(10, tmp_path) is None
    (tmp_path / "self").mkdir()
    (tmp_path / "self" / "smaps_rollup").write_text("")
    assert memory_mib(10, tmp_path) == pytest.approx(7.0)


def test_the_report_names_the_winner_and_the_published_time(tmp_path: Path) -> None:
    """At 1,800 images per hour, 25,000 images take 13.9 hours."""
    runs = [played(Split(1, 1), 4.0, 8.0, 12.0), played(Split(2, 1), 4.0, 4.0, 6.0, 8.0)]
    text = "\n".join(conclusions(runs))
    assert "2.00 times as many" in text
    assert "2x1 wins: 1800 images an hour" in text
    assert "13.9 h with 2x1; published: 101 h" in text
    with bench_console().capture():
        bench_console().print(throughput_table(runs))
    write_json(tmp_path / "farm.json", runs, 3)
    content = json.loads((tmp_path / "farm.json").read_text())
    assert (content["best"], content["seed"]) == ("2x1", 3)
    assert [each["first_image_s"] for each in content["runs"]] == [[4.0], [4.0, 4.0]]
    write_plot(tmp_path / "farm.png", runs)
    assert (tmp_path / "farm.png").stat().st_size > 10_000


def test_no_images_are_refused(tmp_path: Path) -> None:
    """A run without images is refused, as it has no rate."""
    with pytest.raises(SpecError, match="--images"):
        run(tmp_path, seed=0, images=0, splits=SPLITS)
