"""The formula of the second formulation for what is bounded over the whole time: the mean of squares."""

from __future__ import annotations

from typing import Any

import numpy as np

from synergrip.conic.rows import Item, items_of
from synergrip.linalg import interpolated
from synergrip.referee.model import Cone, Expression, Model


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
