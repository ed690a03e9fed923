import numpy as np
import pytest

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.noise import blur, coverage, enlarge, fractal, sample, smoothstep, warp
from tests.assets.built import steps

GRID = Grid(256, 400.0)


@pytest.mark.parametrize(
    ("coarse", "fine", "stretch"),
    [(50.0, 0.0, (1.0, 1.0)), (100.0, 10.0, (1.0, 1.0)), (20.0, 0.0, (12.0, 1.0)), (20.0, 4.0, (1.0, 8.0))],
)
def test_fractal_noise_tiles(coarse: float, fine: float, stretch: tuple[float, float]) -> None:
    """The step across the border is like any other step."""
    field = fractal(np.random.default_rng(1), GRID, coarse, fine, stretch=stretch)
    for axis in (0, 1):
        seam, *inside = steps(field, axis)
        assert seam <= 1.05 * max(inside)


def test_fractal_noise_is_normalised() -> None:
    """A field has mean 0 and standard deviation 1."""
    field = fractal(np.random.default_rng(2), GRID, 60.0, 5.0, gain=0.6)
    assert field.dtype == np.float32
    assert abs(field.mean()) < 1e-4
    assert field.std() == pytest.approx(1.0, abs=1e-3)


def test_the_spectrum_is_the_one_asked_for() -> None:
    """From one frequency to the next octave the power falls as the gain says."""
    gain = 0.5
    power = np.zeros((256, 256))
    for seed in range(12):
        field = fractal(np.random.default_rng(seed), GRID, 400.0, gain=gain)
        power += np.abs(np.fft.fft2(field)) ** 2
    cycles = np.hypot(*np.meshgrid(np.fft.fftfreq(256, 1 / 256), np.fft.fftfreq(256, 1 / 256)))
    rings = [power[(cycles > low) & (cycles <= 2 * low)].sum() for low in (8, 16, 32)]
    # The sum over a ring is the power of an octave, the square of its amplitude.
    assert rings[1] / rings[0] == pytest.approx(gain**2, rel=0.2)
    assert rings[2] / rings[1] == pytest.approx(gain**2, rel=0.2)


def test_isotropic_noise_has_no_preferred_direction() -> None:
    """Steps along x and along y are alike."""
    field = fractal(np.random.default_rng(3), GRID, 20.0, 2.0)
    assert steps(field, 0).mean() == pytest.approx(steps(field, 1).mean(), rel=0.1)


def test_stretch_makes_features_longer() -> None:
    """Stretched along x, a field changes more slowly along x."""
    field = fractal(np.random.default_rng(4), GRID, 20.0, stretch=(10.0, 1.0))
    assert steps(field, 1).mean() < 0.4 * steps(field, 0).mean()


@pytest.mark.parametrize("shape", [(64, 64), (32, 128), (256, 64)])
def test_enlarging_keeps_a_field_periodic(shape: tuple[int, int]) -> None:
    """The enlarged field meets itself at the border."""
    small = np.random.default_rng(5).standard_normal(shape).astype(np.float32)
    large = enlarge(small, 256)
    assert large.shape == (256, 256)
    for axis in (0, 1):
        seam, *inside = steps(large, axis)
        assert seam <= 1.05 * max(inside)


def test_blur_wraps_round() -> None:
    """A spot in the corner spreads into all four corners."""
    spot = GRID.zeros()
    spot[0, 0] = 1.0
    soft = blur(spot, 5.0, GRID)
    assert soft[-1, -1] == pytest.approx(soft[1, 1], rel=0.05)
    assert soft.sum() == pytest.approx(1.0, rel=0.02)


def test_sampling_at_the_texels_returns_the_field() -> None:
    """Positions of the texel centres, even a whole tile away, give the stored values."""
    field = fractal(np.random.default_rng(6), GRID, 30.0)
    x, y = GRID.coordinates()
    found = sample(field, x - np.float32(400.0), y + np.float32(800.0), GRID)
    assert np.abs(found - field).max() < 0.02


def test_warping_by_whole_texels_rolls_the_field() -> None:
    """A constant displacement moves the field round the tile."""
    field = fractal(np.random.default_rng(7), GRID, 30.0)
    move = np.full_like(field, 10 * GRID.texel_mm)
    assert np.abs(warp(field, move, 0 * move, GRID) - np.roll(field, -10, 1)).max() < 0.02


def test_smoothstep_is_flat_at_both_ends() -> None:
    """A smooth step is 0 below, 1 above and a half in the middle."""
    values = smoothstep(1.0, 3.0, np.array([0.0, 1.0, 2.0, 3.0, 4.0], np.float32))
    assert values.tolist() == [0.0, 0.0, 0.5, 1.0, 1.0]


def test_coverage_covers_the_share_asked_for() -> None:
    """About the given share of the area is masked."""
    mask = coverage(fractal(np.random.default_rng(8), GRID, 30.0), 0.3)
    assert mask.mean() == pytest.approx(0.3, abs=0.03)
