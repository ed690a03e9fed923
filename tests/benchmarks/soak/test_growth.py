"""The slope of memory over images."""

import pytest

from benchmarks.soak.growth import MIB, Sample, growth_mib


def test_straight_growth() -> None:
    """Half a MiB per image is fifty per hundred images."""
    samples = [Sample(done, (300 + done // 2) * MIB) for done in range(0, 400, 2)]
    assert growth_mib(samples) == pytest.approx(50.0)


def test_only_later_samples_count() -> None:
    """The memory of a process's first images doesn't count as growth."""
    samples = [Sample(done, (100 + min(done, 50) * 10) * MIB) for done in range(300)]
    assert growth_mib(samples, after=50) == pytest.approx(0.0, abs=1e-6)
    assert (growth_mib(samples) or 0.0) > 10.0


def test_too_few_samples() -> None:
    """Samples with one number of images, or of a process that wasn't there yet, have no slope."""
    assert growth_mib([Sample(3, MIB), Sample(3, 2 * MIB)]) is None
    assert growth_mib([Sample(3, 0), Sample(4, 0)]) is None
