"""What the manifests of a dataset tell of their files: in memory, and in the file `index.cache` for the next command.

The file saves reads, and decides nothing: a row counts only while the listing shows the manifest that it was made of. A
file that is damaged, of another release or of another dataset is passed over, and written again in time. It starts with
a line of JSON; blocks follow, each a line of JSON and its compressed rows.
"""

import hashlib
import zlib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, ValidationError

from farm import __version__
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Receipt
from farm.dataset.outputs import Output, outputs_of
from farm.dataset.paths import CACHE_FILE
from farm.errors import DestinationError
from farm.model import Model, Sha256
from farm.spec.category import Category
from farm.storage import read_parts, write_parts

ABSENT = 2**32 - 1
"""Size, in a row, of a file that is not there; larger files count as one byte less."""

_FORMAT = 1
"""Number to raise when a row or a line of the index gets another meaning while the release stays the same."""

_BLOCK_ROWS = 50_000
"""Rows in a block: some megabytes are packed or unpacked at a time."""

_MOST_STAGES = 32
"""Names of stages that are remembered; the farm has seven."""

_LONGEST_LINE = 10_000
"""Bytes of the longest line of JSON in the file."""

KNOWN, FITS, OWN, LISTED = 1, 2, 4, 8
"""Bits of a row's `state`: it holds what a manifest tells; the manifest fits its job; this process itself has read the
manifest; the last index has its line."""

Array = NDArray[Any]

Listed = tuple[int, float, int]
"""What a listing shows of a manifest: its size as in a row, the time of its last change, the mark of its tag."""


def size_in_row(size: int) -> int:
    """Bring a file's size into the range that a row has."""
    return min(size, ABSENT - 1)


def mark_of(tag: str) -> int:
    """Make 64 bits of an object's tag; 0 if there is none."""
    return int.from_bytes(hashlib.blake2b(tag.encode(), digest_size=8).digest()) if tag else 0


class _Start(Model):
    """The first line.

    Attributes:
        release: the release that wrote the file, with the number of its format.
        identity: the dataset's.
        outputs: roles of the files whose sizes each row has.
        stages: names of the stages whose seconds each row has.
        index_sha256: checksum of the index whose lines the rows' `LISTED` speaks of; None if there is none.
    """

    version: Literal[1] = 1
    release: str
    identity: str
    outputs: tuple[str, ...]
    stages: Annotated[tuple[str, ...], Field(max_length=_MOST_STAGES)]
    index_sha256: Sha256 | None


class _Block(Model):
    """The line before a block: its category, its number of rows, and the size and checksum of their packed bytes."""

    category: Category
    rows: Annotated[int, Field(ge=1, le=_BLOCK_ROWS)]
    bytes: Annotated[int, Field(ge=1)]
    sha256: Sha256


class Memory:
    """A row for each job of a dataset, of some 70 bytes with the seconds of its stages.

    Attributes:
        rows: by category, (quota,) rows with the fields `bytes`, `modified_s` and `mark` of the manifest as it was
            listed, `sizes` of its files in the table's order, `vouched_s`, and `state`, whose bits are above.
            `vouched_s` is the time of the files' last change when they were found to have the manifest's checksums.
        seconds: by stage and category, (quota,) seconds; NaN where a manifest tells none.
        index_sha256: checksum of the index that `LISTED` speaks of; None if there is none.
        unsaved: number of rows that changed since the file was read or written.
    """

    def __init__(self, dataset: Dataset) -> None:
        self._dataset = dataset
        self._outputs: tuple[Output, ...] = outputs_of(dataset.header.spec)
        self._quotas = dataset.header.spec.quotas
        self._type = np.dtype(
            [
                ("bytes", "<u4"),
                ("modified_s", "<f8"),
                ("mark", "<u8"),
                ("sizes", "<u4", (len(self._outputs),)),
                ("vouched_s", "<f8"),
                ("state", "u1"),
            ]
        )
        self.rows: dict[Category, Array] = {
            category: np.zeros(quota, self._type) for category, quota in self._quotas.items()
        }
        self.seconds: dict[str, dict[Category, NDArray[np.float32]]] = {}
        self.index_sha256: str | None = None
        self.unsaved = 0

    def put(self, category: Category, index: int, listed: Listed, receipt: Receipt | None) -> None:
        """Remember what a manifest tells, which this process has just read.

        Args:
            category: category of its job.
            index: index of its job.
            listed: its size, time of change, and mark, as the listing showed them before it was read.
            receipt: what it tells; None if it does not fit its job.
        """
        fits = 0 if receipt is None else FITS
        sizes = [0 if receipt is None else size_in_row(receipt.files[each.folder].bytes) for each in self._outputs]
        self.rows[category][index] = (*listed, sizes, 0.0, KNOWN | OWN | fits)
        timings_s = {} if receipt is None else receipt.timings_s
        for stage in timings_s:
            self._add_stage(stage)
        for stage, by_category in self.seconds.items():
            by_category[category][index] = timings_s.get(stage, np.nan)
        self.unsaved += fits > 0

    def vouch(self, category: Category, index: int, changed_s: float) -> None:
        """Remember that a job's files, of which the last changed at this time, have the manifest's checksums."""
        self.rows[category]["vouched_s"][index] = changed_s
        self.unsaved += 1

    def _add_stage(self, stage: str) -> None:
        if stage not in self.seconds and len(self.seconds) < _MOST_STAGES:
            self.seconds[stage] = {
                category: np.full(quota, np.nan, np.float32) for category, quota in self._quotas.items()
            }

    def means_s(self, category: Category, members: NDArray[np.bool_]) -> dict[str, float]:
        """Average the seconds of each stage over some jobs of a category; stages of none of them are left out.

        Args:
            category: the category.
            members: (quota,) bool, true for the jobs that count.
        """
        found = {}
        for stage, by_category in self.seconds.items():
            seconds = by_category[category][members]
            seconds = seconds[~np.isnan(seconds)]
            if len(seconds):
                found[stage] = float(np.mean(seconds, dtype=np.float64))
        return found

    def _start(self, stages: tuple[str, ...]) -> _Start:
        return _Start(
            release=f"{__version__}/{_FORMAT}",
            identity=self._dataset.identity,
            outputs=tuple(output.role for output in self._outputs),
            stages=stages,
            index_sha256=self.index_sha256,
        )

    def _packed_type(self, stages: int) -> np.dtype[np.void]:
        return np.dtype([("index", "<u4"), ("row", self._type), ("seconds", "<f4", (stages,))])

    def save(self) -> None:
        """Write the file. A dataset that may only be read stays without."""
        with suppress(DestinationError):
            write_parts(self._dataset.storage, CACHE_FILE, self._parts())
        self.unsaved = 0

    def _parts(self) -> Iterator[bytes]:
        stages = tuple(self.seconds)
        yield self._start(stages).model_dump_json().encode() + b"\n"
        for category, rows in self.rows.items():
            # Without time and mark, a replaced manifest of the same size could not be told from its predecessor.
            told = (rows["state"] & FITS > 0) & ((rows["modified_s"] > 0) | (rows["mark"] > 0))
            indices = np.flatnonzero(told)
            for first in range(0, len(indices), _BLOCK_ROWS):
                some = indices[first : first + _BLOCK_ROWS]
                packed = np.zeros(len(some), self._packed_type(len(stages)))
                packed["index"], packed["row"] = some, rows[some]
                packed["row"]["state"] &= ~np.uint8(OWN)
                for place, stage in enumerate(stages):
                    packed["seconds"][:, place] = self.seconds[stage][category][some]
                content = zlib.compress(packed.tobytes(), 1)
                checksum = hashlib.sha256(content).hexdigest()
                block = _Block(category=category, rows=len(some), bytes=len(content), sha256=checksum)
                yield block.model_dump_json().encode() + b"\n" + content

    def load(self) -> None:
        """Read the file, if it is there and of this dataset and release; up to the first damage."""
        try:
            content = b"".join(read_parts(self._dataset.storage, CACHE_FILE))
        except (FileNotFoundError, DestinationError):
            return
        line, place = _line(content, 0)
        try:
            start = _Start.model_validate_json(line)
            self.index_sha256 = start.index_sha256
            if start != self._start(start.stages):
                self.index_sha256 = None
                return
            for stage in start.stages:
                self._add_stage(stage)
            while place < len(content):
                line, place = _line(content, place)
                block = _Block.model_validate_json(line)
                self._take(block, content[place : place + block.bytes], start.stages)
                place += block.bytes
        except (ValidationError, ValueError, zlib.error):
            return

    def _take(self, block: _Block, content: bytes, stages: tuple[str, ...]) -> None:
        """Take a block's rows over; raises ValueError or zlib.error if it is damaged."""
        if hashlib.sha256(content).hexdigest() != block.sha256:
            raise ValueError("damaged")
        kind = self._packed_type(len(stages))
        packed: Array = np.frombuffer(zlib.decompressobj().decompress(content, block.rows * kind.itemsize), kind)
        rows = self.rows.get(block.category)
        if rows is None or len(packed) != block.rows or packed["index"].max() >= len(rows):
            raise ValueError("damaged")
        rows[packed["index"]] = packed["row"]
        rows["state"][packed["index"]] &= np.uint8(KNOWN | FITS | LISTED)
        for column, stage in enumerate(stages):
            self.seconds[stage][block.category][packed["index"]] = packed["seconds"][:, column]

    def set_listed(self, members: Mapping[Category, NDArray[np.bool_]], index_sha256: str) -> None:
        """Note which jobs have a line in the index that was just written, and its checksum."""
        for category, rows in self.rows.items():
            rows["state"] &= ~np.uint8(LISTED)
            rows["state"][members[category]] |= np.uint8(LISTED)
        if index_sha256 != self.index_sha256:
            self.unsaved += sum(int(np.count_nonzero(listed)) for listed in members.values())
        self.index_sha256 = index_sha256


def _line(content: bytes, place: int) -> tuple[bytes, int]:
    """Find the line at a place; return it, and the place after it."""
    end = content.find(b"\n", place, place + _LONGEST_LINE)
    return (content[place:end], end + 1) if end >= 0 else (b"", len(content))
