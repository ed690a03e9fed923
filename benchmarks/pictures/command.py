"""`python -m benchmarks pictures`: the look of each style's pictures, in figures and as contact sheets."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import track

from benchmarks.pictures.drawn_coverage import drawn_coverage
from benchmarks.pictures.making import NamedDataset, make
from benchmarks.pictures.plot import write_plot
from benchmarks.pictures.promises import promises_of
from benchmarks.pictures.report import coverage_table, figures_table, promises_table, spread_table, write_json
from benchmarks.pictures.survey import Distribution, MeasuredPicture, distribution, groups, summarize, survey
from benchmarks.terminal import bench_console
from farm.dataset.contact_sheet import make_contact_sheet
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.errors import SpecError, VerificationError
from farm.spec.category import Category

_SHEET_COLUMNS = 6
"""Pictures in a row of a contact sheet."""
_SHEET_EDGE_PX = 256
"""Edge of a picture on a contact sheet, pixels."""


def run(
    out: Path, *, seed: int, images: int, scenes: int, styles: Sequence[str], datasets: Sequence[NamedDataset]
) -> int:
    """Measure, print the tables, write `pictures.json`, `pictures.png` and a `sheet-NAME.jpg` each into `out`.

    Args:
        out: an existing folder; datasets are made, and kept, in `pictures` below it.
        seed: seed of the datasets that are made.
        images: number of images of each dataset that is made.
        scenes: number of scenes of each category of the published style to label without a render; 0 for none.
        styles: styles to make datasets of and measure.
        datasets: existing datasets to measure.

    Raises:
        SpecError: if there is nothing to measure, or two datasets have the same name.
        VerificationError: if a style breaks a promise; the results are all written before.
        FarmError: the error with which `farm run` ended.
    """
    names = [*styles, *(named.name for named in datasets)]
    if images < 1 or not names or len(set(names)) < len(names):
        raise SpecError("give at least 1 of --images, and each --style and --dataset a name of its own")
    console = bench_console()
    measured: dict[str, list[MeasuredPicture]] = {}
    coverage: dict[Category, Distribution] = {}
    for name, dataset in _datasets(console, out / "pictures", images, seed, styles, datasets):
        sheet = make_contact_sheet(dataset, columns=_SHEET_COLUMNS, edge_px=_SHEET_EDGE_PX)
        (out / f"sheet-{name}.jpg").write_bytes(sheet)
        total = dataset.header.spec.total
        measured[name] = list(track(survey(dataset), name, total=total, console=console, transient=True))
        if name == "published" and scenes:
            coverage = dict(_coverage(console, dataset, scenes))
    summaries = {
        name: {group: summarize(pictures) for group, pictures in groups(every).items()}
        for name, every in measured.items()
    }
    promises = [promise for name, summary in summaries.items() for promise in promises_of(name, summary, coverage)]
    for name, summary in summaries.items():
        console.print(figures_table(name, summary))
    console.print(spread_table(summaries))
    if coverage:
        console.print(coverage_table(coverage))
    if promises:
        console.print(promises_table(promises))
    write_json(out / "pictures.json", seed, measured, summaries, coverage, promises)
    write_plot(out / "pictures.png", measured)
    missed = sum(not promise.kept for promise in promises)
    if missed:
        raise VerificationError(f"{missed} of {len(promises)} promises about the pictures are missed; see the table")
    return 0


def _coverage(console: Console, dataset: Dataset, scenes: int) -> Iterator[tuple[Category, Distribution]]:
    """The distribution of the coverage of labelled scenes, for each category of the dataset."""
    for category in dataset.header.spec.quotas:
        drawn = drawn_coverage(dataset.header, category, scenes)
        shares = track(drawn, f"labels of {category}", total=scenes, console=console, transient=True)
        yield category, distribution(list(shares))


def _datasets(
    console: Console, folder: Path, images: int, seed: int, styles: Sequence[str], datasets: Sequence[NamedDataset]
) -> Iterator[tuple[str, Dataset]]:
    """All datasets by name, the existing ones first, so that a wrong path is reported at once and not after an hour."""
    for named in datasets:
        yield named.name, open_dataset(parse_destination(named.place))
    for style in styles:
        with console.status(f"{style}: {images} images"):
            dataset = make(style, images, seed, folder)
        yield style, dataset
