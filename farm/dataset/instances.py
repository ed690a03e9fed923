"""The instances of a picture: the cable or strand that each number stands for, and how much of it is seen."""

from collections.abc import Iterator
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from farm.model import Model
from farm.scene.cable import Bundle
from farm.scene.scene import Scene
from farm.spec.dataset_spec import DatasetSpec


class VisibleInstance(Model):
    """One instance that a picture shows.

    Attributes:
        id: number of the instance in the instance map, from 1.
        cable: place of its cable in the scene's `cables`, from 0.
        strand: place of the strand in its bundle, from 0; None for a cable that is no bundle.
        pixels: number of pixels of the instance map that have this number.
    """

    id: Annotated[int, Field(ge=1)]
    cable: Annotated[int, Field(ge=0)]
    strand: Annotated[int, Field(ge=0)] | None
    pixels: Annotated[int, Field(ge=1)]


def number_instances(scene: Scene) -> Iterator[tuple[int, int | None]]:
    """Yield the cable and the strand of each instance, in the order of their numbers, of which the first is 1.

    Numbers go cable by cable and, in a bundle, strand by strand. Ties and sticks have none.
    """
    for place, cable in enumerate(scene.cables):
        if isinstance(cable.material, Bundle):
            yield from ((place, strand) for strand in range(len(cable.material.strands)))
        else:
            yield place, None


def list_instances(scene: Scene, instances: NDArray[np.uint16]) -> tuple[VisibleInstance, ...]:
    """List what an instance map shows, by number; instances of which no pixel is seen are left out.

    Args:
        scene: the picture's scene.
        instances: (H, W) instance map.

    Raises:
        ValueError: if the map has a number that no instance of the scene has.
    """
    numbered = list(number_instances(scene))
    pixels = np.bincount(instances.ravel(), minlength=1)
    seen = np.flatnonzero(pixels[1:]) + 1
    if len(seen) and seen[-1] > len(numbered):
        raise ValueError(f"has number {seen[-1]}, but the scene has {len(numbered)} instances")
    return tuple(
        VisibleInstance(id=int(number), cable=cable, strand=strand, pixels=int(pixels[number]))
        for number in seen
        for cable, strand in (numbered[number - 1],)
    )


def find_empty_fault(scene: Scene, instances: NDArray[np.uint16], spec: DatasetSpec) -> str | None:
    """Say that a picture is empty that must not be; None if it shows a cable or may show none.

    A picture may show none if its scene has none, or if the description allows a visible share of 0.

    Args:
        scene: the picture's scene.
        instances: (H, W) instance map.
        spec: description of the picture's dataset.
    """
    if not scene.cables or spec.ranges.cable.least_visible_share == 0 or instances.any():
        return None
    return "is empty, but the scene has cables"
