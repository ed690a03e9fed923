"""Outdoor environments: a works yard and a street."""

import numpy as np

from blend.environments import machines, outdoors, storage
from blend.environments.assembly import Assembly
from blend.environments.palette import DARK_GREY, LIGHT_GREY, ORANGE, WHITE, YELLOW, pick, vary
from blend.environments.scene import Light
from blend.environments.storeroom import lift_truck

Rng = np.random.Generator


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build an outdoor environment: a works yard or a street."""
    return _works(a, rng) if variant % 2 else _street(a, rng)


def _works(a: Assembly, rng: Rng) -> Light:
    a.box((0, 0, -0.2), (90, 90, 0.2), "surface:asphalt", (1.0, 0.98, 0.95))
    a.box((-6, 6, 0.0), (14, 9, 0.012), "surface:concrete_cracked", (0.95, 0.93, 0.9))
    for x, y, turn, width in ((2.0, 14.0, 180.0, 18.0), (-13.0, 3.0, -90.0, 14.0), (15.0, -3.0, 90.0, 16.0)):
        with a.at(x, y, turn=turn):
            outdoors.shed(a, rng, width, rng.uniform(5, 7))
    for x, y, turn in ((-4.0, -13.0, 0.0), (6.0, -14.0, 0.0)):
        with a.at(x, y, turn=turn):
            outdoors.house(a, rng, 9.5, int(rng.integers(2, 4)))
    for x, y, z, turn in (
        (6.5, 7.0, 0.0, 182.0),
        (6.6, 7.1, 2.6, 181.0),
        (-9.0, -6.5, 0.0, 20.0),
        (9.5, 3.0, 0.0, 95.0),
    ):
        with a.at(x, y, z, turn=turn):
            outdoors.container(a, rng)
    for x, y, turn, van in (
        (-5.0, -7.5, 80.0, False),
        (-1.5, -7.8, 95.0, True),
        (2.2, -7.4, 85.0, False),
        (8.5, -5.0, 10.0, True),
    ):
        with a.at(x, y, turn=turn):
            outdoors.car(a, rng, van=van)
    with a.at(-5.5, 4.2, turn=-35):
        lift_truck(a, rng)
    for x, y in ((-3.3, 6.5), (-1.9, 6.8), (-7.5, 7.0), (4.2, 3.9), (-8.6, 1.0), (2.9, 4.4)):
        with a.at(x, y, turn=rng.uniform(-10, 10)):
            storage.pallet(a, rng, int(rng.integers(0, 5)))
    for x, y in ((5.4, -1.5), (5.9, -0.8), (5.2, -0.4), (-6.5, -2.6), (3.9, 1.9)):
        with a.at(x, y):
            machines.drum(a, rng)
    for n in range(6):
        with a.at(-10.0, -3.0 + 0.75 * n, turn=-90):
            outdoors.wheeled_bin(a, rng)
    for x, y, turn in ((12.0, 9.5, 30.0), (-12.0, -9.0, 100.0)):
        with a.at(x, y, turn=turn):
            outdoors.tree(a, rng)
    with a.at(0, -10.2):
        outdoors.fence(a, rng, 34)
    for x in np.arange(-12.0, 13.0, 1.7):
        with a.at(float(x), -10.9):
            outdoors.bush(a, rng, 1.9, rng.uniform(0.7, 1.5))
    for x, y, turn in ((-1.0, -9.6, 0.0), (11.0, 6.0, 90.0)):
        with a.at(x, y, turn=turn):
            outdoors.lamp_post(a, rng)
    outdoors.wires(a, rng, (-20, -11.5, 7.0), (18, -9.5, 7.2))
    for x in (-4.0, -0.5, 3.0, 6.5):
        a.box((x, -6.8, 0.0), (0.1, 4.2, 0.004), "paint", WHITE)
    for n in range(5):
        _cone(a, 1.6 + 0.9 * n, 2.6 + 0.25 * n)
    return Light(
        camera_m=(0.0, 0.0, 1.6),
        sky=1.0,
        overcast=0.55,
        sun=3.6,
        sun_bearing_deg=-50.0,
        sun_height_deg=38.0,
        ambient=(0.85, 0.93, 1.05),
        reach_m=60.0,
        town=True,
    )


def _cone(a: Assembly, x: float, y: float) -> None:
    a.box((x, y, 0), (0.34, 0.34, 0.03), "rubber", DARK_GREY)
    a.cylinder((x, y, 0.03), 0.13, 0.62, "plastic", ORANGE, top=0.03)
    a.cylinder((x, y, 0.28), 0.095, 0.13, "plastic", WHITE, top=0.072)


def _street(a: Assembly, rng: Rng) -> Light:
    a.box((0, 0, -0.25), (120, 120, 0.2), "surface:asphalt", (0.95, 0.95, 0.97))
    for side in (-1, 1):
        a.box((0, side * 6.6, -0.05), (120, 4.2, 0.17), "surface:paving_slabs", (0.95, 0.93, 0.9))
        a.box((0, side * 4.4, -0.05), (120, 0.2, 0.19), "wall", LIGHT_GREY)
        x = -38.0
        while x < 38.0:
            width = rng.uniform(7.0, 12.0)
            with a.at(x + 0.5 * width, side * 8.8, 0.1, turn=180 if side > 0 else 0):
                outdoors.house(a, rng, width, int(rng.integers(2, 5)), 8.0)
            x += width + (rng.uniform(1.5, 4.0) if rng.random() < 0.25 else 0.0)
        for x in np.arange(-30.0, 32.0, 9.0):
            with a.at(float(x) + rng.uniform(-1, 1) + 2.5 * side, side * 5.1, 0.1):
                pick(rng, (outdoors.tree, outdoors.tree, outdoors.lamp_post))(a, rng)
        for x in np.arange(-26.0, 28.0, 5.6):
            if rng.random() < 0.72 and abs(x) > 2.0:
                with a.at(float(x) + rng.uniform(-0.5, 0.5), side * 3.3, -0.05, turn=-90 * side + rng.normal(0, 1.5)):
                    outdoors.car(a, rng, van=rng.random() < 0.2)
        for x, thing in (
            (-3.2, outdoors.bench),
            (2.4, outdoors.wheeled_bin),
            (3.1, outdoors.wheeled_bin),
            (5.6, outdoors.road_sign),
            (-7.4, outdoors.bush),
            (9.0, outdoors.bush),
        ):
            with a.at(x + rng.uniform(-0.6, 0.6), side * 7.6, 0.12, turn=180 if side > 0 else 0):
                thing(a, rng)
    for x in np.arange(-40.0, 40.0, 4.0):
        a.box((float(x), 0.0, -0.05), (2.0, 0.12, 0.004), "paint", WHITE)
    for x, turn in ((-40.0, -90.0), (40.0, 90.0)):
        for y in (-9.0, 3.0):
            with a.at(x, y + 3.0, turn=turn):
                outdoors.house(a, rng, 12.0, 4, 8.0)
    outdoors.wires(a, rng, (-30, 5.2, 6.0), (32, 4.8, 6.1))
    for n in range(4):
        _cone(a, 4.0 + 1.2 * n, -1.6 + 0.2 * n)
    a.box((6.5, -2.2, -0.05), (2.2, 0.1, 1.0), "paint", vary(rng, YELLOW))
    return Light(
        camera_m=(0.0, 1.4, 1.6),
        sky=1.0,
        overcast=0.15,
        sun=4.2,
        sun_bearing_deg=155.0,
        sun_height_deg=34.0,
        ambient=(0.6, 0.75, 1.0),
        reach_m=60.0,
        town=True,
    )
