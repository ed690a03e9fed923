"""What the rendering benchmark finds for a variant, and which variants are worth having."""

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
        """Mean over the scenes."""
        return float(np.mean([shot.errors.flip for shot in self.shots]))

    @property
    def psnr_db(self) -> float:
        """Mean over the scenes."""
        return float(np.mean([shot.errors.psnr_db for shot in self.shots]))


def front(rows: Iterable[Row]) -> tuple[Row, ...]:
    """The rows of which none is both faster and better, in FLIP or in PSNR, than any other; the fastest first."""
    ordered = sorted(rows, key=lambda row: (row.seconds, row.flip))
    kept: list[Row] = []
    for row in ordered:
        if all(row.flip < other.flip or row.psnr_db > other.psnr_db for other in kept):
            kept.append(row)
    return tuple(kept)


def idle_settings(rows: Sequence[Row]) -> list[str]:
    """Turned settings that gave the base's pictures to the byte in every scene, though they need not have.

    Either nothing in these scenes is touched by them, or they did not act.

    Args:
        rows: rows of all categories, among them those of the variant called "base".
    """
    return [variant.name for variant, same in _against_base(rows) if same and not variant.same_picture]


def disturbing_settings(rows: Sequence[Row]) -> list[str]:
    """Settings that changed a picture though they may not; see `idle_settings`."""
    return [variant.name for variant, same in _against_base(rows) if variant.same_picture and not same]


def _against_base(rows: Sequence[Row]) -> Iterator[tuple[Variant, bool]]:
    """Each variant but the base, and whether its pictures are the base's."""
    base = _pictures(row for row in rows if row.variant.name == "base")
    for variant in dict.fromkeys(row.variant for row in rows if row.variant.name != "base"):
        pictures = _pictures(row for row in rows if row.variant == variant)
        yield variant, all(base.get(scene) == digest for scene, digest in pictures.items())


def _pictures(rows: Iterable[Row]) -> Mapping[str, str]:
    return {shot.scene: shot.sha256 for row in rows for shot in row.shots}
