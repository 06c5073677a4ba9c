"""Quantities at every knot, affine in the unknowns there, with one matrix for all knots or one for each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from synergrip.documents.judging import as_numbers, described
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError
from synergrip.linalg import Array, Places, frozen, sealed
from synergrip.values import Value


@dataclass(frozen=True, eq=False, repr=False)
class Affine(Value):
    """``y_k = matrix @ v_k + constant[k]``, or ``matrix[k] @ v_k + constant[k]``: m quantities at each of T knots."""

    matrix: Array  # (m, n_v), or (T, m, n_v)
    constant: Array  # (T, m)

    @naming_arguments
    def after(self, linear: Array) -> Affine:
        """Return ``linear @ y`` for linear (p, m), or (T, p, m) when it differs from knot to knot.

        Raises:
            InputError: no numbers, or another number of columns than there are quantities.
        """
        T, m = self.constant.shape
        found = as_numbers(linear)
        if found is None or found.ndim not in (2, 3) or found.shape[-1] != m or found.shape[:-2] not in ((), (T,)):
            wanted = f"shape (p, {m}), a column for each quantity, or ({T}, p, {m}) with one matrix for each knot"
            hint = "; one row is linear[None, :]" if found is not None and found.shape == (m,) else ""
            raise InputError.at("Affine.after.linear", f"expected {wanted}; got {described(linear)}{hint}")
        return self.mapped(found)

    def mapped(self, linear: Array) -> Affine:
        """Return what `after` does for a matrix, or one for each knot, that is known to fit."""
        if linear.ndim > self.matrix.ndim:  # one product with the rows of all knots is many times as fast
            T, p, m = linear.shape
            matrix = (linear.reshape(T * p, m) @ self.matrix).reshape(T, p, self.matrix.shape[1])
        else:
            matrix = linear @ self.matrix
        return Affine(sealed(matrix), sealed(times(linear, self.constant)))

    @naming_arguments
    def plus(self, known: Array) -> Affine:
        """Return ``y_k + known[k]`` for known (T, m); (m,) or a number when it is the same at all knots.

        Raises:
            InputError: no numbers, or another shape.
        """
        T, m = self.constant.shape
        found = as_numbers(known)
        if found is None or found.shape not in ((), (m,), (T, m)):
            wanted = f"a number, shape ({m},) with one for each quantity, or ({T}, {m}) with a row for each knot"
            raise InputError.at("Affine.plus.known", f"expected {wanted}; got {described(known)}")
        return Affine(self.matrix, sealed(self.constant + found))

    def taken(self, places: Sequence[int]) -> Affine:
        """Return the quantities at some places (p,)."""
        return Affine(sealed(self.matrix[..., places, :]), sealed(self.constant[:, places]))

    def at_knots(self, places: Places) -> Affine:
        """Return the quantities at some of the knots."""
        matrix = self.matrix if self.matrix.ndim == 2 else sealed(self.matrix[places])
        return Affine(matrix, sealed(self.constant[places]))

    @property
    def shortened(self) -> Affine:
        """As few quantities (n_v + 1 at most) of the same norm at every knot, for one matrix at each."""
        if self.matrix.shape[-2] <= self.matrix.shape[-1] + 1:
            return self
        whole = np.asarray(np.linalg.qr(np.concatenate([self.matrix, self.constant[:, :, None]], axis=-1), mode="r"))
        return Affine(frozen(whole[:, :, :-1]), frozen(whole[:, :, -1]))

    def in_units(self, factor: float) -> Affine:
        """Return the same quantities of unknowns in units that are that many times as large."""
        return Affine(sealed(self.matrix * factor), self.constant)

    def at(self, v: Array) -> Array:
        """Return y (T, m) at unknowns v (T, n_v)."""
        return np.asarray(self.constant + times(self.matrix, v))


def times(matrix: Array, values: Array) -> Array:
    """Return ``matrix @ values[k]`` (T, p) for values (T, m) and one matrix (p, m), or one for each, (T, p, m)."""
    if matrix.ndim == 2 or len(matrix) == 1 < len(values):
        return np.asarray(values @ matrix.reshape(matrix.shape[-2:]).T)
    return np.asarray((matrix @ values[:, :, None])[:, :, 0])
