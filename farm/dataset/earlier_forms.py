"""Reads headers of earlier releases whose keys lay elsewhere."""

from collections.abc import Mapping
from typing import Any

_CLOTH_KEYS = ("max_frames", "quality", "collision_quality")
"""Keys of the cloth's settings, which lay in `fall` itself while cloth was the one simulator."""


def in_todays_form(written: Mapping[str, Any]) -> Mapping[str, Any]:
    """Put a header's values where this release looks for them; what is in place already stays as it is.

    Args:
        written: the values of `dataset.json`, of whatever release, not validated.
    """
    if not isinstance(spec := written.get("spec"), Mapping):
        return written
    fall = spec.get("fall")
    if not isinstance(fall, Mapping) or "simulator" in spec or not set(_CLOTH_KEYS) & fall.keys():
        return written
    cloth = {key: fall[key] for key in _CLOTH_KEYS if key in fall}
    rest = {key: value for key, value in fall.items() if key not in _CLOTH_KEYS}
    return {**written, "spec": {**spec, "simulator": "cloth", "fall": {**rest, "cloth": cloth}}}
