"""The formulas of the second formulation for the mean over time of squares: bounded, or as small as can be."""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.conic.goals.least_holding import LeastHolding
from synergrip.conic.rows import Item, items_of
from synergrip.linalg import interpolated
from synergrip.referee.model import Cone, Expression, Model, Written
from synergrip.referee.motion_formulas import times_rows


def over_time(model: Model, limit: Any, names: tuple[str, ...], value: Expression) -> tuple[Cone, ...]:
    """Write ``integral of value^2 dt <= limit^2 duration`` down, by quadrature of the second order in each step.

    Where nothing moves, the last value counts as well.
    """
    times, keep = model.times, np.flatnonzero(np.isfinite(limit.limit))
    cones: list[Cone] = []
    if len(keep) and (len(times) == 1 or not np.abs(model.target).max(initial=0.0)):
        share = value[-1:, keep] @ np.diag(1 / limit.limit[keep])
        low, high = (items_of((names[i] for i in keep), side) for side in ("lowest", "highest"))
        cones += Cone(limit.key, low, 1 + share), Cone(limit.key, high, 1 - share)
    if len(times) == 1:
        return tuple(cones)
    nodes, weights = np.polynomial.legendre.leggauss(2)  # on -1 to 1, where the weights add up to 2
    half = np.diff(times)[:, None] / 2
    instants = (times[:-1, None] + half * (1 + nodes)).ravel()
    parts = (half * weights).ravel() / (times[-1] - times[0])
    rows = np.sqrt(parts)[:, None] * interpolated(instants, times, np.eye(len(times)))
    for i in keep:
        mean = (rows @ value[:, [i]] / limit.limit[i]).T
        cones.append(Cone(limit.key, (Item(names[i], "norm"),), np.ones(1), mean))
    return tuple(cones)


def least_holding(model: Model, goal: LeastHolding) -> Written:
    """Write the mean of the squares down, by Simpson's rule in each step, which is exact for parabolas."""
    import cvxpy as cp

    value = model.torque if goal.of == "torque" else model.effort
    share = value / (model.force_unit * model.response.scale.length)
    if len(model.times) == 1:
        return Written(0.5 * cp.sum_squares(share))
    h = len(model.times) * np.diff(model.times)[:, None] / (model.times[-1] - model.times[0])
    ends = share[:-1], (share[:-1] + share[1:]) / 2, share[1:]
    parts = (cp.sum_squares(times_rows(np.sqrt(w * h / 6), part)) for w, part in zip((1, 4, 1), ends, strict=True))
    return Written(0.5 * sum(parts))
