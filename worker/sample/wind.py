"""Samples the wind and its gusts."""

import numpy as np

from farm.scene.physics import Gust, Wind
from farm.spec.ranges.placement import WindRanges
from worker.sample.values import uniform

GUSTS = 3
"""Number of oscillations that are added to the wind's mean speed."""


def sample_wind(ranges: WindRanges, rng: np.random.Generator) -> Wind:
    """Sample the wind and its gusts.

    Args:
        ranges: ranges of the style.
        rng: random generator of the wind.
    """
    strength = uniform(rng, ranges.strength)
    return Wind(
        bearing_deg=uniform(rng, ranges.bearing_deg),
        distance=uniform(rng, ranges.distance),
        height=uniform(rng, ranges.height),
        tilt_deg=uniform(rng, ranges.tilt_deg),
        strength=strength,
        flow=strength * ranges.flow_per_strength,
        speed_m_s=strength * ranges.speed_per_strength_m_s,
        gusts=tuple(_sample_gust(ranges, rng) for _ in range(GUSTS)),
    )


def _sample_gust(ranges: WindRanges, rng: np.random.Generator) -> Gust:
    return Gust(
        share=uniform(rng, ranges.gust_share),
        period_s=uniform(rng, ranges.gust_period_s),
        phase_deg=float(rng.uniform(0.0, 360.0)),
    )
