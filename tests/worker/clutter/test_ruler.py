"""A ruler's marks have true distances."""

import numpy as np
import pytest

from worker.clutter.ruler import LENGTHS_M, ruler_marks

LENGTH_M = 0.2
ROWS, COLUMNS = 166, 1333


def places_of_marks(row: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Positions along the ruler, metres, of the middles of the marks that a row of texels crosses."""
    ink = ruler_marks(LENGTH_M, ROWS, COLUMNS)[row].astype(np.float64)
    starts = np.flatnonzero(np.diff((ink > 0).astype(int), prepend=0) == 1)
    ends = np.flatnonzero(np.diff((ink > 0).astype(int), append=0) == -1)
    middles = [
        float(np.average(np.arange(a, b + 1) + 0.5, weights=ink[a : b + 1])) for a, b in zip(starts, ends, strict=True)
    ]
    return np.array(middles) * LENGTH_M / COLUMNS


def test_marks_are_a_millimetre_apart() -> None:
    """The 195 marks on 200 mm begin 5 mm in and end at the edge, each right to a tenth of a texel of 0.15 mm."""
    places = places_of_marks(3)
    assert len(places) == 196
    assert places[:-1] == pytest.approx(5e-3 + 1e-3 * np.arange(195), abs=1.5e-5)


def test_longer_marks_are_a_centimetre_apart() -> None:
    """The marks that reach as far as only the longest do are a centimetre apart."""
    row = round(0.5 * (LENGTHS_M[5] + LENGTHS_M[10]) * COLUMNS / LENGTH_M)
    assert np.diff(places_of_marks(row)) == pytest.approx(1e-2, abs=1e-5)
