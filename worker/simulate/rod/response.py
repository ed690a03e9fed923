"""The velocities that the impulse of a contact causes, by the columns of the operator's inverse."""

from worker.simulate.rod.arrays import Bodies, Contacts, Integers
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array


@compiled
def _respond(
    response: Array, reach: int, weights: Array, side: int, n: int, base: int, span: tuple[int, int], column: Array
) -> float:
    """Fill in the column of one side of a contact.

    Args:
        response: (nodes, width) response of the operator, 1/kg.
        reach: number of nodes on either side beyond which the response is negligible.
        weights: (2, n, 4) weights of the contacts' nodes.
        side: side of the contact, 0 or 1.
        n: number of the contact.
        base: number of the first of the contact's four nodes on this side.
        span: numbers of the first node that responds, and of the one after the last.
        column: (2, n, max) array whose entry [side, n] gets the velocities per impulse, 1/kg.

    Returns:
        The velocity per impulse of the contact's point on this side, 1/kg.
    """
    centre = (response.shape[1] - 1) // 2
    low, high = span
    for j in range(high - low):
        column[side, n, j] = 0.0
    for k in range(4):
        node, weight = base + k, weights[side, n, k]
        if weight != 0.0:
            for j in range(max(low, node - reach), min(high, node + reach + 1)):
                column[side, n, j - low] += weight * response[node, j - node + centre]
    total = 0.0
    for k in range(4):
        total += weights[side, n, k] * column[side, n, base + k - low]
    return total


@compiled
def _crosstalk(base: Integers, weights: Array, n: int, low: Integers, width: Integers, column: Array) -> float:
    """Compute the velocity that an impulse on the second side of contact n gives to its first side, 1/kg.

    Both sides are of one rod. The arguments are the parts of `Contacts`.
    """
    total = 0.0
    for k in range(4):
        j = base[0, n] + k - low[1, n]
        if 0 <= j < width[1, n]:
            total += weights[0, n, k] * column[1, n, j]
    return total


@compiled
def fill_columns(bodies: Bodies, operator: Operator, contacts: Contacts, n: int) -> None:
    """Find the compliances of contact n and the columns of its two sides."""
    base, low, width = contacts.base, contacts.low, contacts.width
    for side in range(2):
        middle = base[side, n]
        rod = bodies.owner[middle]
        reach = operator.reach[rod]
        begin, end = max(bodies.first[rod], middle - reach), min(bodies.first[rod + 1], middle + 4 + reach)
        low[side, n], width[side, n] = begin, end - begin
        contacts.own[side, n] = _respond(
            operator.response, reach, contacts.weights, side, n, middle, (begin, end), contacts.column
        )
    compliance = contacts.own[0, n] + contacts.own[1, n]
    if bodies.owner[base[0, n]] == bodies.owner[base[1, n]]:
        compliance -= 2 * _crosstalk(base, contacts.weights, n, low, width, contacts.column)
    contacts.compliance[n] = max(compliance, 0.0)


@compiled
def push(column: Array, begin: int, low: int, width: int, x: float, y: float, z: float, v: Array) -> None:
    """Add the velocities that an impulse causes.

    Args:
        column: velocities per impulse, 1/kg.
        begin: number of the first entry of `column` that counts.
        low: number of the first node that responds.
        width: number of nodes that respond.
        x: x of the impulse, N s.
        y: y of the impulse, N s.
        z: z of the impulse, N s.
        v: (3, nodes) velocities, m/s, changed in place.
    """
    for j in range(width):
        share = column[begin + j]
        v[0, low + j] += x * share
        v[1, low + j] += y * share
        v[2, low + j] += z * share
