"""The forces that are known at the start of a step: pulls, gravity, bending, natural curvature, tension and wind."""

import numpy as np

from worker.simulate.rod.arrays import Bodies, Motion
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array
from worker.simulate.rod.world import World, air_velocity

LEAST_ALIGNED = 0.1
"""Share of its natural bend about one axis below which a rod's axis of natural curvature fades: it then has no clear
direction."""

UPRIGHT = 1e-3
"""Share of that bend that counts as about the vertical whatever the rod's shape: a straight rod would not know where to
bend. It turns a coil less than its weight does."""

AIR_DENSITY_KG_M3 = 1.2
"""Density of air at 20 degrees Celsius and sea level, in kg/m3."""

DRAG_COEFFICIENT = 1.1
"""Drag coefficient of a long cylinder across the flow, for Reynolds numbers from 1e2 to 1e5 (Hoerner 1965,
"Fluid-Dynamic Drag", ch. 3)."""

SKIN_COEFFICIENT = 0.02
"""Drag coefficient of a long cylinder along the flow, relative to its diameter: pi 1.328 / sqrt(Re) for a laminar skin
at Re = 4e4 (Hoerner, ch. 2)."""


@compiled
def _load_share(bodies: Bodies, motion: Motion, rod: int) -> float:
    """Compute the share of a rod's inertia on which gravity and wind act."""
    return 1.0 / bodies.inertia[rod] if motion.landed[rod] else 1.0


@compiled
def _add_gravity(bodies: Bodies, motion: Motion, gravity: Array, force: Array) -> None:
    """Add the weight of each node to `force` (3, nodes), N."""
    for rod in range(len(bodies.length)):
        share = _load_share(bodies, motion, rod)
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            for c in range(3):
                force[c, i] += share * bodies.mass[i] * gravity[c]


@compiled
def natural_axis(bodies: Bodies, x: Array, rod: int) -> tuple[float, float, float, float]:
    """Find the axis about which a rod is curved by nature.

    Rods carry no material frame. The natural curvature k acts about one axis for the whole rod, the one about which the
    rod is bent as its nature asks: along B = sum(k e1 x e2), with the two edges at each node. It turns with the rod, so
    a coil may tip over. While B is less than `LEAST_ALIGNED` of what it is in the natural shape, the axis is shorter
    than 1.

    Returns:
        The axis (x, y, z), and the energy of the natural curvature over -EI / l^2, m.
    """
    bx = by = bz = natural = 0.0
    for i in range(bodies.first[rod] + 1, bodies.first[rod + 1] - 1):
        k = bodies.curvature[i]
        if k != 0.0:
            px, py, pz = x[0, i] - x[0, i - 1], x[1, i] - x[1, i - 1], x[2, i] - x[2, i - 1]
            qx, qy, qz = x[0, i + 1] - x[0, i], x[1, i + 1] - x[1, i], x[2, i + 1] - x[2, i]
            bx += k * (py * qz - pz * qy)
            by += k * (pz * qx - px * qz)
            bz += k * (px * qy - py * qx)
            natural += k * k
    natural *= bodies.length[rod] ** 3
    bz += UPRIGHT * natural
    size, least = np.sqrt(bx * bx + by * by + bz * bz), LEAST_ALIGNED * natural
    if natural == 0.0:
        return 0.0, 0.0, 0.0, 0.0
    if size < least:
        return bx / least, by / least, bz / least, 0.5 * (size * size / least + least)
    return bx / size, by / size, bz / size, size


@compiled
def _add_elastic(bodies: Bodies, motion: Motion, rod: int, force: Array) -> None:
    """Add the forces of a rod's bending about its natural shape to `force` (3, nodes), N."""
    first, end, length = bodies.first[rod], bodies.first[rod + 1], bodies.length[rod]
    x = motion.x
    stiff = bodies.stiffness[rod] / length**3
    ax, ay, az, _ = natural_axis(bodies, x, rod)
    for i in range(first + 1, end - 1):
        for c in range(3):
            bend = stiff * (x[c, i - 1] - 2 * x[c, i] + x[c, i + 1])
            force[c, i - 1] -= bend
            force[c, i] += 2 * bend
            force[c, i + 1] -= bend
        # The energy of natural curvature k about the axis a is -EI k / l^2 (e1 x e2) . a.
        turn = bodies.stiffness[rod] * bodies.curvature[i] / length**2
        if turn != 0.0:
            px, py, pz = x[0, i] - x[0, i - 1], x[1, i] - x[1, i - 1], x[2, i] - x[2, i - 1]
            qx, qy, qz = x[0, i + 1] - x[0, i], x[1, i + 1] - x[1, i], x[2, i + 1] - x[2, i]
            # By e1 the energy changes with e2 x a, by e2 with a x e1.
            fx, fy, fz = turn * (qy * az - qz * ay), turn * (qz * ax - qx * az), turn * (qx * ay - qy * ax)
            gx, gy, gz = turn * (ay * pz - az * py), turn * (az * px - ax * pz), turn * (ax * py - ay * px)
            force[0, i - 1] -= fx
            force[1, i - 1] -= fy
            force[2, i - 1] -= fz
            force[0, i] += fx - gx
            force[1, i] += fy - gy
            force[2, i] += fz - gz
            force[0, i + 1] += gx
            force[1, i + 1] += gy
            force[2, i + 1] += gz


@compiled
def add_tension(bodies: Bodies, motion: Motion, step: float, momentum: Array) -> None:
    """Add the impulse of the last step's tension along the present segments to `momentum` (3, nodes), N s."""
    x = motion.x
    for i in range(len(bodies.mass) - 1):
        if motion.tension[i] != 0.0:
            pull = step * motion.tension[i] / bodies.length[bodies.owner[i]]
            for c in range(3):
                edge = pull * (x[c, i + 1] - x[c, i])
                momentum[c, i] += edge
                momentum[c, i + 1] -= edge


@compiled
def _add_wind(bodies: Bodies, motion: Motion, air: Array, step: float, force: Array) -> None:
    """Add the drag on each segment to `force` (3, nodes), N.

    The air's velocity u across and along the segment each give rho/2 C d l |u| u, half of it to either node. The drag
    is that of the step's end with |u| of its start, so that the wind does not make a light rod faster than the air.
    """
    x, v = motion.x, motion.v
    for i in range(len(bodies.mass) - 1):
        rod = bodies.owner[i]
        if bodies.owner[i + 1] != rod:
            continue
        length = bodies.length[rod]
        tx = (x[0, i + 1] - x[0, i]) / length
        ty = (x[1, i + 1] - x[1, i]) / length
        tz = (x[2, i + 1] - x[2, i]) / length
        ux = air[0] - 0.5 * (v[0, i] + v[0, i + 1])
        uy = air[1] - 0.5 * (v[1, i] + v[1, i + 1])
        uz = air[2] - 0.5 * (v[2, i] + v[2, i + 1])
        along = ux * tx + uy * ty + uz * tz
        ux, uy, uz = ux - along * tx, uy - along * ty, uz - along * tz
        across = np.sqrt(ux * ux + uy * uy + uz * uz)
        per_speed = 0.5 * AIR_DENSITY_KG_M3 * 2 * bodies.radius[rod] * length
        per_speed *= bodies.inertia[rod] * _load_share(bodies, motion, rod)
        mass = max(bodies.mass[i], bodies.mass[i + 1])
        push = _damped(per_speed * DRAG_COEFFICIENT * across, step, mass)
        rub = _damped(per_speed * SKIN_COEFFICIENT * abs(along), step, mass) * along
        for j in (i, i + 1):
            force[0, j] += 0.5 * (push * ux + rub * tx)
            force[1, j] += 0.5 * (push * uy + rub * ty)
            force[2, j] += 0.5 * (push * uz + rub * tz)


@compiled
def _damped(drag: float, step: float, mass: float) -> float:
    """Limit a drag per speed, kg/s, so that a step may stop a mass, kg, against the air, but not throw it back."""
    return drag / (1 + step * drag / mass)


@compiled
def resisted(bodies: Bodies, motion: Motion, world: World, step: float, rod: int) -> float:
    """Compute the speed, m/s, that dry resistance takes from a rod in a step: 0 if nothing touches the rod."""
    if not motion.touched[rod]:
        return 0.0
    return world.resistance * step * _load_share(bodies, motion, rod)


@compiled
def _resist(bodies: Bodies, motion: Motion, world: World, step: float, momentum: Array) -> None:
    """Slow the nodes of rods that touch something, or stop them, in `momentum` (3, nodes), N s."""
    for rod in range(len(bodies.length)):
        most = resisted(bodies, motion, world, step, rod)
        if most == 0.0:
            continue
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            speed = np.sqrt(motion.v[0, i] ** 2 + motion.v[1, i] ** 2 + motion.v[2, i] ** 2)
            if speed > 0.0:
                share = min(most / speed, 1.0)
                for c in range(3):
                    momentum[c, i] -= share * bodies.mass[i] * motion.v[c, i]


@compiled
def momentum_to_be(bodies: Bodies, motion: Motion, world: World, step: float, time: float, momentum: Array) -> None:
    """Compute M v + h f: the momentum at the end of the step without contact and tension.

    Args:
        bodies: the rods.
        motion: places and velocities of the rods.
        world: gravity, wind and resistance.
        step: time step h, s.
        time: time at the end of the step, s.
        momentum: (3, nodes) array that gets the momentum, N s.
    """
    force = bodies.pull.copy()
    _add_gravity(bodies, motion, world.gravity, force)
    for rod in range(len(bodies.length)):
        _add_elastic(bodies, motion, rod, force)
    if world.drag:
        air = np.empty(3)
        air_velocity(world, time, air)
        _add_wind(bodies, motion, air, step, force)
    for c in range(3):
        for i in range(len(bodies.mass)):
            momentum[c, i] = bodies.mass[i] * motion.v[c, i] + step * force[c, i]
    _resist(bodies, motion, world, step, momentum)
