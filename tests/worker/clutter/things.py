"""Clutter for the tests."""

from farm.scene.clutter import Part, PartKind, Sheet, SheetKind, Stick, StickKind


def make_stick(kind: StickKind = StickKind.ROD, *, seed: int = 0, diameter_m: float = 0.008, **keys: object) -> Stick:
    """A stick of 140 mm along x through the origin."""
    values = {
        "kind": kind,
        "diameter_m": diameter_m,
        "length_m": 0.14,
        "x_m": 0.0,
        "y_m": 0.0,
        "start_height_m": 0.001,
        "rotation_deg": 0.0,
        "colour": (190, 40, 30),
        "pattern_seed": seed,
    }
    return Stick.model_validate(values | keys)


def make_sheet(kind: SheetKind, *, seed: int = 0, **keys: object) -> Sheet:
    """A sheet of 80 by 20 mm around the origin."""
    values = {
        "kind": kind,
        "x_m": 0.0,
        "y_m": 0.0,
        "rotation_deg": 0.0,
        "length_m": 0.08,
        "width_m": 0.02,
        "colour": (200, 180, 60),
        "pattern_seed": seed,
    }
    return Sheet.model_validate(values | keys)


def make_part(kind: PartKind = PartKind.WASHER, *, seed: int = 0, **keys: object) -> Part:
    """A part of 12 mm at the origin."""
    values = {
        "kind": kind,
        "x_m": 0.0,
        "y_m": 0.0,
        "rotation_deg": 0.0,
        "size_m": 0.012,
        "colour": (30, 30, 30),
        "pattern_seed": seed,
    }
    return Part.model_validate(values | keys)
