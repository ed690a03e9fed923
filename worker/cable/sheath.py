"""Paints a cable's sheath on its canvas: plain plastic, clear plastic over copper, or a braid."""

import numpy as np

from farm.scene.cable import Skin
from worker.cable.canvas import Canvas, pigment, tone
from worker.noise import Field, rough_wrapped_noise, wrapped_noise

_STRAND_M = 0.00035
"""Apparent width of a conductor's fine strands, in metres; clear plastic magnifies them."""

_COPPER = tone(0.96, 0.68, 0.53)
"""Colour of copper under clear plastic, sRGB."""

_TINNED = tone(0.84, 0.83, 0.80)
"""Colour of tinned copper under clear plastic, sRGB."""

_TINNED_SHARE = 0.25
"""Share of clear cables with tinned copper: often one of the two conductors of a loudspeaker cable is tinned."""

_CARRIER_M = 0.0008
"""Width of a braid's carriers, the flat strands that cross, in metres."""

_BRAID_TANGENT = 0.84
"""Tangent of the angle between a braid's carriers and the cable's axis, 40 degrees."""

_METAL_ROUGHNESS = 0.3
"""Roughness below which a grey braid is metal."""

_METAL_TINT = 40
"""Difference between a colour's largest and smallest sRGB level, below which a braid counts as grey."""


def draw_plain(canvas: Canvas, skin: Skin, rng: np.random.Generator) -> None:
    """Paint extruded plastic on a canvas, in place: faintly mottled, streaked along, with a slightly uneven gloss."""
    shape = canvas.shape
    mottle = rough_wrapped_noise(rng, shape, canvas.cells(0.004, 0.007), 2)
    streaks = wrapped_noise(rng, shape, canvas.cells(0.0006, 0.05))
    canvas.colour[:] = pigment(skin.colour) * (1.0 + 0.018 * mottle + 0.014 * streaks)
    canvas.roughness[:] = np.clip(skin.roughness * (1.0 + 0.08 * mottle + 0.10 * streaks), 0.08, 1.0)
    canvas.height_m = _unevenness(canvas, rng)


def draw_translucent(canvas: Canvas, skin: Skin, rng: np.random.Generator) -> None:
    """Paint bright copper strands under clear, slightly milky plastic on a canvas, in place; the strands wind round."""
    wide_m = max(_STRAND_M, 3.0 * canvas.texel_m[0])
    count = int(np.clip(round(canvas.around_m / wide_m), 5, 48))
    pitch_m = rng.uniform(3.2, 4.6) * canvas.around_m * rng.choice([-1.0, 1.0])
    wander = 0.12 * wrapped_noise(rng, canvas.shape, canvas.cells(canvas.around_m / 4, 0.012))
    place = count * (canvas.around + canvas.along_m / np.float32(pitch_m)) + wander
    strand = np.floor(place).astype(np.int32) % count
    across = 2.0 * (place - np.floor(place)) - 1.0
    bulge = np.sqrt(np.maximum(1.0 - 0.92 * across * across, 0.0)).astype(np.float32)
    shine = (1.0 + 0.12 * rng.standard_normal(count)).astype(np.float32)[strand]
    shine *= 1.0 + 0.05 * wrapped_noise(rng, canvas.shape, canvas.cells(0.0008, 0.006))
    metal = _TINNED if rng.random() < _TINNED_SHARE else _COPPER
    canvas.colour[:] = metal * np.minimum((0.12 + 0.88 * bulge) * shine, 1.0)
    milk = 0.13 + 0.05 * rough_wrapped_noise(rng, canvas.shape, canvas.cells(0.003, 0.02), 2)
    canvas.blend(np.clip(milk, 0.0, 0.4), pigment(skin.colour))
    canvas.roughness[:] = 0.30
    canvas.height_m = np.float32(0.22 * wide_m) * bulge
    canvas.metallic, canvas.coat = 0.8, 1.0


def draw_braid(canvas: Canvas, skin: Skin, rng: np.random.Generator) -> None:
    """Paint a braid on a canvas, in place: carriers wind both ways, over and under each other.

    A grey, glossy braid is metal, any other textile. A share of the carriers has the stripe's colour, like the tracers
    that are woven into braids.
    """
    rows_m = canvas.texel_m[0]
    count = 2 * int(np.clip(round(canvas.around_m / max(_CARRIER_M, 4.5 * rows_m) / 2), 2, 14))
    turns = canvas.along_m * np.float32(_BRAID_TANGENT / canvas.around_m)
    wander = 0.05 * wrapped_noise(rng, canvas.shape, canvas.cells(0.0015, 0.003))
    right = count * (canvas.around + turns) + wander
    left = count * (canvas.around - turns) - wander
    right_id, left_id = np.floor(right).astype(np.int32), np.floor(left).astype(np.int32)
    right_across, left_across = right - right_id - 0.5, left - left_id - 0.5
    # Each carrier goes over two and under two, a twill; their number is even, so the pattern closes around the cable.
    right_above = (right_id - left_id) % 4 < 2 if count % 4 == 0 else (right_id - left_id) % 2 == 0
    across = np.where(right_above, right_across, left_across)
    lengthwise = np.where(right_above, left_across, right_across)
    carrier = np.where(right_above, right_id % count, left_id % count + count)
    crown = np.sqrt(np.maximum(1.0 - 3.4 * across * across, 0.0)).astype(np.float32)
    dip = (1.0 - 1.1 * lengthwise * lengthwise).astype(np.float32)
    height = crown * dip
    tones = _carrier_tones(skin, count, rng)
    grain = rough_wrapped_noise(rng, canvas.shape, canvas.cells(0.0003, 0.0004), 2)
    shade = (0.42 + 0.58 * height) * (1.0 + 0.06 * grain)
    for plane, of_carrier in zip(canvas.colour, tones.T, strict=True):
        np.multiply(of_carrier[carrier], shade, out=plane)
    canvas.height_m = np.float32(0.28 * canvas.around_m / count) * height
    metal = skin.roughness < _METAL_ROUGHNESS and max(skin.colour) - min(skin.colour) < _METAL_TINT
    canvas.metallic = 0.9 if metal else 0.0
    base = 0.36 if metal else max(skin.roughness, 0.55)
    canvas.roughness[:] = np.clip(base + 0.05 * grain, 0.1, 1.0)


def _carrier_tones(skin: Skin, count: int, rng: np.random.Generator) -> Field:
    """Sample the carriers' colours, (2 * count, 3) sRGB: first those that wind right, then those that wind left."""
    base = pigment(skin.colour).reshape(1, 3)
    tones = base * (1.0 + 0.07 * rng.standard_normal((2 * count, 1))).astype(np.float32)
    second = rng.random() < 0.5
    if skin.stripe is None and second:
        # In a melange some carriers have a lighter yarn.
        lighter = rng.random(2 * count) < 0.3
        tones[lighter] = 0.62 * tones[lighter] + 0.38 * np.float32(0.75)
    if skin.stripe is not None:
        tracers = round(skin.stripe.share * count)
        for start in (0, count):
            which = start + (np.arange(tracers) * count // max(tracers, 1)) % count
            tones[which] = pigment(skin.stripe.colour).reshape(1, 3)
    return np.clip(tones, 0.02, 1.0).astype(np.float32)


def _unevenness(canvas: Canvas, rng: np.random.Generator) -> Field:
    """Sample a relief, in metres, of waves and the plastic's grain: without it, a highlight is one straight line."""
    waves = wrapped_noise(rng, canvas.shape, canvas.cells(canvas.around_m / 4, 0.009))
    grain = wrapped_noise(rng, canvas.shape, canvas.cells(0.0007, 0.0012))
    return (22e-6 * waves + 2.5e-6 * grain).astype(np.float32)
