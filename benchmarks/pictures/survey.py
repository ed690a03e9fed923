"""Measure a whole dataset picture by picture, and summarize the figures."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.pictures.colour import Histogram, colour_histogram, entropy_bits, mean_hellinger
from benchmarks.pictures.picture_figures import PictureFigures, measure
from farm.dataset.dataset import Dataset
from farm.dataset.index import done_manifests
from farm.dataset.manifest import Manifest
from farm.dataset.outputs import IMAGE, INSTANCES, MASK, Output
from farm.errors import VerificationError
from farm.spec.category import Category

FIGURES = tuple(field.name for field in fields(PictureFigures))

_ONCE = "open"
"""Name of the stage that a process goes through once, not with each picture."""


@dataclass(frozen=True, slots=True)
class MeasuredPicture:
    """One picture of a dataset.

    Attributes:
        job_id: identifier of the picture's job.
        category: category of the picture.
        figures: figures of the picture.
        colours: histogram of the picture's colours.
        seconds: time of all stages but opening the template, which a process does once.
    """

    job_id: str
    category: Category
    figures: PictureFigures
    colours: Histogram
    seconds: float


@dataclass(frozen=True, slots=True)
class Distribution:
    """The distribution of one figure over many pictures.

    Attributes:
        pictures: number of pictures that have the figure.
        mean: mean over them.
        deviation: standard deviation of the sample.
        p5: 5th percentile.
        p50: median.
        p95: 95th percentile.
    """

    pictures: int
    mean: float
    deviation: float
    p5: float
    p50: float
    p95: float


@dataclass(frozen=True, slots=True)
class Summary:
    """The figures of a group of pictures.

    Attributes:
        pictures: number of pictures.
        figures: distribution of each figure, by its name.
        entropy_bits: entropy of the colours of all pictures together, bits.
        hellinger: mean Hellinger distance between two pictures' colours.
        seconds: mean time of a picture.
    """

    pictures: int
    figures: dict[str, Distribution]
    entropy_bits: float
    hellinger: float
    seconds: float


def survey(dataset: Dataset) -> Iterator[MeasuredPicture]:
    """Measure every finished picture.

    Raises:
        VerificationError: if a picture can't be decoded.
        DestinationError: if the dataset can't be read.
    """
    for job, manifest in done_manifests(dataset):
        picture = _read(dataset, manifest, IMAGE, cv2.IMREAD_COLOR)[:, :, ::-1].astype(np.uint8)
        mask = _read(dataset, manifest, MASK, cv2.IMREAD_GRAYSCALE).astype(np.uint8)
        instances = _read(dataset, manifest, INSTANCES, cv2.IMREAD_UNCHANGED).astype(np.uint16)
        seconds = sum(taken for stage, taken in manifest.timings_s.items() if stage != _ONCE)
        figures = measure(picture, mask, instances)
        yield MeasuredPicture(job.id, job.category, figures, colour_histogram(picture), seconds)


def groups(pictures: Sequence[MeasuredPicture]) -> dict[Category | None, list[MeasuredPicture]]:
    """All pictures under None, then those of each category that has any."""
    found: dict[Category | None, list[MeasuredPicture]] = {None: list(pictures)}
    for category in Category:
        if chosen := [picture for picture in pictures if picture.category is category]:
            found[category] = chosen
    return found


def summarize(pictures: Sequence[MeasuredPicture]) -> Summary:
    """Summarize a group of pictures."""
    histograms = [picture.colours for picture in pictures]
    return Summary(
        pictures=len(pictures),
        figures={name: distribution(values_of(pictures, name)) for name in FIGURES},
        entropy_bits=entropy_bits(histograms),
        hellinger=mean_hellinger(histograms),
        seconds=float(np.mean([picture.seconds for picture in pictures])) if pictures else float("nan"),
    )


def values_of(pictures: Iterable[MeasuredPicture], figure: str) -> list[float]:
    """The values of one figure, of all pictures that have it."""
    values = [float(asdict(picture.figures)[figure]) for picture in pictures]
    return [value for value in values if not np.isnan(value)]


def distribution(values: Sequence[float]) -> Distribution:
    """The distribution of values; its entries are NaN if there are too few values for them."""
    if not values:
        return Distribution(0, *([float("nan")] * 5))
    deviation = float(np.std(values, ddof=1)) if len(values) > 1 else float("nan")
    p5, p50, p95 = (float(value) for value in np.percentile(values, (5, 50, 95)))
    return Distribution(len(values), float(np.mean(values)), deviation, p5, p50, p95)


def _read(dataset: Dataset, manifest: Manifest, output: Output, how: int) -> NDArray[np.generic]:
    path = manifest.files[output.folder].path
    decoded = cv2.imdecode(np.frombuffer(dataset.storage.read(path), np.uint8), how)
    if decoded is None:
        raise VerificationError(
            f"{dataset.storage.location}/{path}: can't decode this image; farm repair makes it again"
        )
    return np.asarray(decoded)
