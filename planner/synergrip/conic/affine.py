"""Quantities at every knot, affine in the unknowns there."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.linalg import Array, frozen
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Affine(Value):
    """``y_k = matrix @ v_k + constant[k]``."""

    matrix: Array  # (m, n_v)
    constant: Array  # (T, m)

    def after(self, linear: Array) -> Affine:
        """Return ``linear @ y`` for linear (p, m)."""
        return Affine(frozen(linear @ self.matrix), frozen(self.constant @ linear.T))

    def plus(self, known: Array) -> Affine:
        """Return ``y_k + known[k]`` for known (T, m)."""
        return replace(self, constant=frozen(self.constant + known))

    def at(self, v: Array) -> Array:
        """Return y (T, m) at unknowns v (T, n_v)."""
        return np.asarray(self.constant + v @ self.matrix.T)
