"""Solves the equations of a chain of nodes in blocks of a node's unknowns: three coordinates and a multiplier.

In 4x4 blocks the matrix is symmetric and pentadiagonal: D on the diagonal, B next to it, and C next to B; C couples
each coordinate only with itself. With S = D^-1 and the right-hand side r, the elimination of node i,

    W = S B,  V = S C,  z = S r,

leaves node i + 1 with D - B^T W, B - W^T C and r - B^T z, and node i + 2 with D - C V and r - C z: C does not change.
From the last node back, the solution is u[i] = z - W u[i + 1] - V u[i + 2].

There is no pivoting, so every reduced D must be regular. It is, if the part of the coordinates is positive definite and
each multiplier belongs to the last of the nodes on which it acts.
"""

from typing import NamedTuple

from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

DIAGONAL, RIGHT, NEXT, BEYOND, OWN, LATER = 0, 4, 8, 11, 14, 17
"""Offsets in a node's row of its equations: 4 numbers each of the diagonal and the right-hand side; then 3 numbers each
that couple its coordinates with the same coordinates of the next node (NEXT) and of the one after (BEYOND), with its
own multiplier (OWN), and with the multiplier of the next node (LATER)."""

W, V, SOLUTION = 0, 16, 28
"""Offsets in a node's row of the columns of W and V, 4 numbers each, and of z, which becomes the solution."""

ROW = 32
"""Number of numbers in a row."""

Four = tuple[float, float, float, float]
"""A vector, or a column of a matrix: three coordinates x, y, z and a multiplier s."""

NOTHING = (0.0, 0.0, 0.0, 0.0)


class Symmetric(NamedTuple):
    """The upper half of a symmetric 4x4 matrix."""

    xx: float
    xy: float
    xz: float
    xs: float
    yy: float
    yz: float
    ys: float
    zz: float
    zs: float
    ss: float


class Matrix(NamedTuple):
    """The columns of a 4x4 matrix."""

    x: Four
    y: Four
    z: Four
    s: Four


@compiled
def _dot(a: Four, b: Four) -> float:
    return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3])


@compiled
def _times(s: Symmetric, v: Four) -> Four:
    return (
        _dot((s.xx, s.xy, s.xz, s.xs), v),
        _dot((s.xy, s.yy, s.yz, s.ys), v),
        _dot((s.xz, s.yz, s.zz, s.zs), v),
        _dot((s.xs, s.ys, s.zs, s.ss), v),
    )


@compiled
def _inverse(d: Symmetric) -> Symmetric:
    """Invert by 2x2 blocks [P R; R^T Q]: with T = P^-1 R, the inverse of Q - R^T T is the last block of the inverse."""
    p = 1.0 / (d.xx * d.yy - d.xy * d.xy)
    pxx, pxy, pyy = p * d.yy, -p * d.xy, p * d.xx
    txz, txs = pxx * d.xz + pxy * d.yz, pxx * d.xs + pxy * d.ys
    tyz, tys = pxy * d.xz + pyy * d.yz, pxy * d.xs + pyy * d.ys
    qzz = d.zz - (d.xz * txz + d.yz * tyz)
    qzs = d.zs - (d.xz * txs + d.yz * tys)
    qss = d.ss - (d.xs * txs + d.ys * tys)
    q = 1.0 / (qzz * qss - qzs * qzs)
    zz, zs, ss = q * qss, -q * qzs, q * qzz
    xz, xs = -(txz * zz + txs * zs), -(txz * zs + txs * ss)
    yz, ys = -(tyz * zz + tys * zs), -(tyz * zs + tys * ss)
    return Symmetric(
        xx=pxx - (xz * txz + xs * txs),
        xy=pxy - (xz * tyz + xs * tys),
        xz=xz,
        xs=xs,
        yy=pyy - (yz * tyz + ys * tys),
        yz=yz,
        ys=ys,
        zz=zz,
        zs=zs,
        ss=ss,
    )


@compiled
def _own_diagonal(d: Symmetric, row: Array) -> Symmetric:
    """Add a node's own equations to the rest that the eliminated nodes have left there: D."""
    return Symmetric(
        xx=d.xx + row[DIAGONAL],
        xy=d.xy,
        xz=d.xz,
        xs=d.xs + row[OWN],
        yy=d.yy + row[DIAGONAL + 1],
        yz=d.yz,
        ys=d.ys + row[OWN + 1],
        zz=d.zz + row[DIAGONAL + 2],
        zs=d.zs + row[OWN + 2],
        ss=d.ss + row[DIAGONAL + 3],
    )


@compiled
def _own_next(b: Matrix, row: Array) -> Matrix:
    """Add a node's own equations to the rest that the eliminated nodes have left there: B."""
    return Matrix(
        x=(b.x[0] + row[NEXT], b.x[1], b.x[2], b.x[3]),
        y=(b.y[0], b.y[1] + row[NEXT + 1], b.y[2], b.y[3]),
        z=(b.z[0], b.z[1], b.z[2] + row[NEXT + 2], b.z[3]),
        s=(row[LATER], row[LATER + 1], row[LATER + 2], 0.0),
    )


@compiled
def _left_at_next(d: Symmetric, b: Matrix, w: Matrix) -> Symmetric:
    """Compute D - B^T W."""
    return Symmetric(
        xx=d.xx - _dot(b.x, w.x),
        xy=d.xy - _dot(b.x, w.y),
        xz=d.xz - _dot(b.x, w.z),
        xs=d.xs - _dot(w.x, b.s),
        yy=d.yy - _dot(b.y, w.y),
        yz=d.yz - _dot(b.y, w.z),
        ys=d.ys - _dot(w.y, b.s),
        zz=d.zz - _dot(b.z, w.z),
        zs=d.zs - _dot(w.z, b.s),
        ss=d.ss - _dot(b.s, w.s),
    )


@compiled
def _left_beyond(c: Four, v: Matrix) -> Symmetric:
    """Compute -C V."""
    return Symmetric(
        xx=-c[0] * v.x[0],
        xy=-c[0] * v.y[0],
        xz=-c[0] * v.z[0],
        xs=0.0,
        yy=-c[1] * v.y[1],
        yz=-c[1] * v.z[1],
        ys=0.0,
        zz=-c[2] * v.z[2],
        zs=0.0,
        ss=0.0,
    )


@compiled
def _left_between(c: Four, w: Matrix) -> Matrix:
    """Compute -W^T C."""
    return Matrix(
        x=(-c[0] * w.x[0], -c[0] * w.y[0], -c[0] * w.z[0], -c[0] * w.s[0]),
        y=(-c[1] * w.x[1], -c[1] * w.y[1], -c[1] * w.z[1], -c[1] * w.s[1]),
        z=(-c[2] * w.x[2], -c[2] * w.y[2], -c[2] * w.z[2], -c[2] * w.s[2]),
        s=NOTHING,
    )


@compiled
def _keep(row: Array, w: Matrix, v: Matrix, z: Four) -> None:
    for k in range(4):
        row[W + k], row[W + 4 + k], row[W + 8 + k], row[W + 12 + k] = w.x[k], w.y[k], w.z[k], w.s[k]
        row[V + k], row[V + 4 + k], row[V + 8 + k] = v.x[k], v.y[k], v.z[k]
        row[SOLUTION + k] = z[k]


@compiled
def _eliminate(rows: Array) -> None:
    """Eliminate from the first node to the last; W, V and z replace each row's equations."""
    # The rest that the eliminated nodes have left at this node, and at the next.
    d = d_next = Symmetric(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    b = Matrix(NOTHING, NOTHING, NOTHING, NOTHING)
    r = r_next = NOTHING
    for i in range(len(rows)):
        row = rows[i]
        d, b = _own_diagonal(d, row), _own_next(b, row)
        c = (row[BEYOND], row[BEYOND + 1], row[BEYOND + 2], 0.0)
        r = (r[0] + row[RIGHT], r[1] + row[RIGHT + 1], r[2] + row[RIGHT + 2], r[3] + row[RIGHT + 3])
        s = _inverse(d)
        w = Matrix(_times(s, b.x), _times(s, b.y), _times(s, b.z), _times(s, b.s))
        v = Matrix(
            x=(s.xx * c[0], s.xy * c[0], s.xz * c[0], s.xs * c[0]),
            y=(s.xy * c[1], s.yy * c[1], s.yz * c[1], s.ys * c[1]),
            z=(s.xz * c[2], s.yz * c[2], s.zz * c[2], s.zs * c[2]),
            s=NOTHING,
        )
        z = _times(s, r)
        _keep(row, w, v, z)
        r = (r_next[0] - _dot(b.x, z), r_next[1] - _dot(b.y, z), r_next[2] - _dot(b.z, z), -_dot(b.s, z))
        r_next = (-c[0] * z[0], -c[1] * z[1], -c[2] * z[2], 0.0)
        d, d_next = _left_at_next(d_next, b, w), _left_beyond(c, v)
        b = _left_between(c, w)


@compiled
def _column(row: Array, at: int) -> Four:
    return row[at], row[at + 1], row[at + 2], row[at + 3]


@compiled
def _less(a: Four, b: Four, factor: float) -> Four:
    return a[0] - b[0] * factor, a[1] - b[1] * factor, a[2] - b[2] * factor, a[3] - b[3] * factor


@compiled
def solve(rows: Array) -> None:
    """Solve the equations of a chain of nodes in place.

    Args:
        rows: (nodes, ROW) equations at `DIAGONAL` and the offsets after it; what couples with nodes beyond the last
            must be zero, and the rest of a row is ignored. The solution replaces them at `SOLUTION`; all else is lost.
    """
    _eliminate(rows)
    # The solutions of the next node, and of the one after it.
    u = u_after = NOTHING
    for i in range(len(rows) - 1, -1, -1):
        row = rows[i]
        solution = _less(_column(row, SOLUTION), _column(row, V), u_after[0])
        solution = _less(solution, _column(row, V + 4), u_after[1])
        solution = _less(solution, _column(row, V + 8), u_after[2])
        solution = _less(solution, _column(row, W), u[0])
        solution = _less(solution, _column(row, W + 4), u[1])
        solution = _less(solution, _column(row, W + 8), u[2])
        solution = _less(solution, _column(row, W + 12), u[3])
        u, u_after = solution, u
        for k in range(4):
            row[SOLUTION + k] = u[k]
