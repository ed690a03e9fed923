"""The table of outputs: every file that a picture consists of, except its manifest.

Layout, completeness, index, verification and upload go by this table. A new label is one more row, and the function in
`worker/label/` that the row names; docs/how-to/add-a-label.md has the steps.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from farm.dataset.formats import PNG, FileFormat
from farm.scene.picture_size import PictureSize
from farm.spec.dataset_spec import DatasetSpec


@dataclass(frozen=True, slots=True)
class Agreement:
    """A check of one output of a picture against another output of the same picture.

    Attributes:
        other: role of the output to compare with.
        find_fault: takes the content and the other's, both without a fault of their own; says what is wrong, or None.
    """

    other: str
    find_fault: Callable[[Any, Any], str | None]


@dataclass(frozen=True, slots=True)
class Output:
    """A row of the table: a kind of file that every picture has. The format defines the type of its content.

    Attributes:
        role: the output's name in code and, with that of its checksum, in the index.
        folder: folder of its files below the category's. The manifest lists the file under this name.
        format: the type of its files.
        find_fault: takes a content and the size of the dataset's pictures; says what is wrong, or None.
        agreements: checks against other outputs; one that a dataset lacks is not compared.
        maker: place of the function that makes the file's content, as `module:function`; None if the renderer makes it.
            See `worker.label.makers.Maker`.
    """

    role: str
    folder: str
    format: FileFormat
    find_fault: Callable[[Any, PictureSize], str | None]
    agreements: tuple[Agreement, ...] = ()
    maker: str | None = None


def array_fault(pixels: NDArray[np.generic], shape: tuple[int, ...], kind: DTypeLike) -> str | None:
    """Say how an array's shape or type differs from what it must be; None if both are right."""
    if pixels.shape == shape and pixels.dtype == np.dtype(kind):
        return None
    return f"{pixels.shape} {pixels.dtype}, expected {shape} {np.dtype(kind)}"


def _image_fault(pixels: NDArray[np.generic], resolution: PictureSize) -> str | None:
    return array_fault(pixels, (*resolution.shape, 3), np.uint8)


def _binary_fault(pixels: NDArray[np.generic], resolution: PictureSize) -> str | None:
    fault = array_fault(pixels, resolution.shape, np.uint8)
    if fault is None and not ((pixels == 0) | (pixels == 255)).all():
        fault = "has other values than 0, 255"
    return fault


def _instances_fault(pixels: NDArray[np.generic], resolution: PictureSize) -> str | None:
    return array_fault(pixels, resolution.shape, np.uint16)


def _instances_fill_mask(instances: NDArray[np.uint16], mask: NDArray[np.uint8]) -> str | None:
    return None if np.array_equal(mask == 255, instances > np.uint16(0)) else "does not agree with the mask"


IMAGE = Output("image", "images", PNG, _image_fault)
"""(H, W, 3) uint8 sRGB."""

MASK = Output("mask", "masks", PNG, _binary_fault, maker="worker.label.label:make_mask_and_instances")
"""(H, W) uint8: 255 where a cable is seen, else 0."""

INSTANCES = Output(
    "instances",
    "instances",
    PNG,
    _instances_fault,
    agreements=(Agreement(MASK.role, _instances_fill_mask),),
    maker="worker.label.label:make_mask_and_instances",
)
"""(H, W) uint16: 0 for background; counted from 1, cable by cable and strand by strand of a bundle."""

OUTPUTS = (IMAGE, MASK, INSTANCES)
"""All rows, in the order in which files are written, listed and indexed."""


def outputs_of(spec: DatasetSpec) -> tuple[Output, ...]:
    """List the outputs that each picture of a dataset has, in the table's order."""
    del spec  # no description can leave one out
    return OUTPUTS


def find_faults(
    outputs: Iterable[Output], contents: Mapping[str, Any], resolution: PictureSize
) -> Iterator[tuple[Output, str]]:
    """Check the contents of one picture's files, each alone and then those without a fault against each other.

    Args:
        outputs: the outputs that the picture must have.
        contents: contents by role; roles that are not there are not checked.
        resolution: size of the dataset's pictures.

    Yields:
        An output and what is wrong with its content.
    """
    there = [output for output in outputs if output.role in contents]
    sound = set()
    for output in there:
        fault = output.find_fault(contents[output.role], resolution)
        if fault is None:
            sound.add(output.role)
        else:
            yield output, fault
    for output in there:
        for agreement in output.agreements:
            if {output.role, agreement.other} <= sound:
                fault = agreement.find_fault(contents[output.role], contents[agreement.other])
                if fault is not None:
                    yield output, fault
