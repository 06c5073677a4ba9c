"""Squares of changes from knot to knot, and of their changes: what smooth plans have little of."""

from __future__ import annotations

import numpy as np

from synergrip.conic.formulation import Affine
from synergrip.conic.goals.goal import Squares
from synergrip.conic.rows import Earlier
from synergrip.linalg import Array, frozen

STIFFEST, RESCALED = 1e6, 1e4
"""Largest entry of the Hessian of rates and accelerations; beyond, rounding would drown the bends between many knots.
A factor before a goal changes no plan, only how closely the solver looks at it: less closely, but to the end, with the
second, which is for programs that do not verify with the first."""


def differences(value: Affine, unit: Array | float, times: Array, order: int, stiffest: float) -> Squares:
    """Return first or second differences over uneven knots; their sum of squares is T times an integral over [0, 1].

    A row is divided by nothing that changes from knot to knot but by weights, since one matrix serves all knots:
    the weight of the newest knot stands before the whole row.

    Args:
        value: m affine quantities at the knots, more than `order` of these.
        unit: of the quantities, (m,) or one for all.
        times: (T,) [s].
        order: 1 for rates, 2 for accelerations.
        stiffest: the largest entry of the Hessian, at most; infinity for the factor T.
    """
    units = np.broadcast_to(np.asarray(unit, dtype=float), (value.constant.shape[1],))
    weights = _weights(times, order)  # (K, order + 1), newest first
    weights = weights * np.sqrt(len(times))
    weights = weights * min(1.0, np.sqrt(stiffest) / float(np.abs(weights).max()))
    matrix, known = value.matrix / units[:, None], value.constant / units
    count = len(weights)
    constant = sum(weights[:, lag, None] * known[order - lag : order - lag + count] for lag in range(order + 1))
    earlier = tuple(Earlier(lag, frozen(matrix), frozen(weights[:, lag])) for lag in range(order + 1))
    return Squares(frozen(np.zeros_like(matrix)), frozen(constant), earlier)


def _weights(times: Array, order: int) -> Array:
    """Return the weights of knots k, k - 1, ... in each difference, for a task that lasts 1."""
    h = np.diff(times) / (times[-1] - times[0])
    if order == 1:
        root = 1 / np.sqrt(h)
        return np.column_stack([root, -root])
    before, after = h[:-1], h[1:]
    span = (before + after) / 2
    root = np.sqrt(span)
    return np.column_stack([root / (span * after), -root * (1 / after + 1 / before) / span, root / (span * before)])
