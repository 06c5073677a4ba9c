"""The linear maps of the second formulation: the same at all knots, or one for each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from synergrip.linalg import Array
from synergrip.statics import Coordinates, Response
from synergrip.statics.analysis import Analysis
from synergrip.statics.each import Each

Expression = Any
"""A CVXPY expression, variable, constraint or problem: CVXPY has no types to speak of."""


@dataclass(frozen=True)
class Maps:
    """Response and coordinates of a grasp, and those at each knot where they are not the same at all."""

    response: Response
    coordinates: Coordinates
    each: tuple[Analysis | Each, ...] = ()

    def of(self, read: Callable[[Maps | Analysis | Each], Array]) -> Array:
        """Return what is read of them: (...) when it is the same at all knots, (T, ...) when each has its own."""
        return np.array([read(at) for at in self.each]) if self.each else np.asarray(read(self))


def mapped(matrix: Array, value: Expression) -> Expression:
    """Return each row k of value (T, m) under matrix (p, m), or under the k-th of matrix (T, p, m)."""
    import cvxpy as cp

    if np.ndim(matrix) == 2:
        return value @ matrix.T
    rows = [each @ value[k] for k, each in enumerate(matrix)]
    return np.array(rows) if isinstance(value, np.ndarray) else cp.vstack(rows)
