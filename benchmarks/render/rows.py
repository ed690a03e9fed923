"""The measurements of a variant, and the variants that are worth having."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.render.errors import Errors
from benchmarks.render.variants import Variant
from farm.spec.category import Category


@dataclass(frozen=True, slots=True)
class Shot:
    """One scene rendered with a variant.

    Attributes:
        scene: id of the scene's job.
        build_s: seconds to build the scene.
        render_s: seconds to render it.
        errors: the picture's errors against the scene's reference.
        sha256: checksum of the picture.
    """

    scene: str
    build_s: float
    render_s: float
    errors: Errors
    sha256: str


@dataclass(frozen=True, slots=True)
class Row:
    """A variant on the scenes of a category."""

    variant: Variant
    category: Category
    shots: tuple[Shot, ...]

    @property
    def seconds(self) -> float:
        """Mean seconds of building and rendering."""
        return float(np.mean([shot.build_s + shot.render_s for shot in self.shots]))

    @property
    def flip(self) -> float:
        """Mean FLIP over the scenes."""
        return float(np.mean([shot.errors.flip for shot in self.shots]))

    @property
    def psnr_db(self) -> float:
        """Mean PSNR over the scenes, dB."""
        return float(np.mean([shot.errors.psnr_db for shot in self.shots]))


def front(rows: Iterable[Row]) -> tuple[Row, ...]:
    """The rows worth having, the fastest first: each is better than all faster ones, in FLIP or in PSNR."""
    ordered = sorted(rows, key=lambda row: (row.seconds, row.flip))
    kept: list[Row] = []
    for row in ordered:
        if all(row.flip < other.flip or row.psnr_db > other.psnr_db for other in kept):
            kept.append(row)
    return tuple(kept)


def idle_settings(rows: Sequence[Row]) -> list[str]:
    """Changed settings that gave the base's pictures to the byte in every scene, although they may change pictures.

    Either they affect nothing in these scenes, or they had no effect at all.

    Args:
        rows: rows of all categories, among them those of the variant called "base".
    """
    return [variant.name for variant, same in _against_base(rows) if same and not variant.same_picture]


def disturbing_settings(rows: Sequence[Row]) -> list[str]:
    """Changed settings that must not change a picture and did.

    Args:
        rows: rows of all categories, including those of the variant called "base".
    """
    return [variant.name for variant, same in _against_base(rows) if variant.same_picture and not same]


def _against_base(rows: Sequence[Row]) -> Iterator[tuple[Variant, bool]]:
    """Each variant but the base, and whether its pictures are the base's."""
    base = _pictures(row for row in rows if row.variant.name == "base")
    for variant in dict.fromkeys(row.variant for row in rows if row.variant.name != "base"):
        pictures = _pictures(row for row in rows if row.variant == variant)
        yield variant, all(base.get(scene) == digest for scene, digest in pictures.items())


def _pictures(rows: Iterable[Row]) -> Mapping[str, str]:
    return {shot.scene: shot.sha256 for row in rows for shot in row.shots}
