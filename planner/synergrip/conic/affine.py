"""Quantities at every knot, affine in the unknowns there, with one matrix for all knots or one for each."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Affine(Value):
    """``y_k = matrix @ v_k + constant[k]``, or ``matrix[k] @ v_k + constant[k]``."""

    matrix: Array  # (m, n_v), or (T, m, n_v)
    constant: Array  # (T, m)

    def after(self, linear: Array) -> Affine:
        """Return ``linear @ y`` for linear (p, m), or (T, p, m) when it differs from knot to knot."""
        return Affine(frozen(linear @ self.matrix), frozen(times(linear, self.constant)))

    def plus(self, known: Array) -> Affine:
        """Return ``y_k + known[k]`` for known (T, m)."""
        return replace(self, constant=frozen(self.constant + known))

    def in_units(self, factor: float) -> Affine:
        """Return the same quantities of unknowns in units that are that many times as large."""
        return replace(self, matrix=frozen(self.matrix * factor))

    def at(self, v: Array) -> Array:
        """Return y (T, m) at unknowns v (T, n_v)."""
        return np.asarray(self.constant + times(self.matrix, v))


def times(matrix: Array, values: Array) -> Array:
    """Return ``matrix @ values[k]`` (T, p) for values (T, m) and one matrix (p, m), or one for each, (T, p, m)."""
    if matrix.ndim == 2:
        return np.asarray(values @ matrix.T)
    return np.asarray((matrix @ values[:, :, None])[:, :, 0])
