"""The matrix ``P + A'W^-2 A`` of all knots: banded, with a border; its factor and what is solved with it.

With B the band, C the border's columns beside it and D its corner, ``B = L L'`` by LAPACK's banded Cholesky factor and
the corner's ``D - C'B^-1 C`` by a dense one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.linalg import cho_factor, cho_solve, lapack

from synergrip.conic.banded.columns import Columns
from synergrip.conic.banded.cones import Cones, Scaling
from synergrip.conic.banded.sheets import Sheet
from synergrip.linalg import Array

SHIFTS = (1e-15, 1e-12, 1e-9)
"""By what share of itself each diagonal entry grows before it is factored, the first that does."""


class NoFactorError(ArithmeticError):
    """The matrix is not positive definite to its digits."""


@dataclass(frozen=True)
class Matrix:
    """What is the same in all iterations."""

    band: Array  # (width, banded) of P, the diagonal first, as LAPACK has lower bands
    beside: Array  # (banded, p) of P
    corner: Array  # (p, p) of P
    sheets: tuple[Sheet, ...]
    step: int
    """Unknowns of a knot."""

    @classmethod
    def of(cls, P: sparse.csr_matrix, columns: Columns, sheets: Sequence[Sheet]) -> Matrix:
        """Return it for P in the order of the columns."""
        nb = columns.banded
        lower = sparse.coo_matrix(sparse.tril(P[:nb, :nb]))
        reach = max([int((lower.row - lower.col).max(initial=0)), *(sheet.width - 1 for sheet in sheets), 0])
        band = np.zeros((reach + 1, nb))
        np.add.at(band, (lower.row - lower.col, lower.col), lower.data)
        return cls(band, P[:nb, nb:].toarray(), P[nb:, nb:].toarray(), tuple(sheets), columns.step)

    def times(self, x: Array, cones: Cones) -> Array:
        """Return A x (m,) in the order of the lanes."""
        result = np.empty(len(cones.order))
        for sheet in self.sheets:
            sheet.times(x, cones.at(sheet.family, result))
        return result

    def back(self, y: Array, cones: Cones, unknowns: int) -> Array:
        """Return A'y (n,) of y (m,) in the order of the lanes."""
        result = np.zeros(unknowns)
        for sheet in self.sheets:
            sheet.add_back(cones.at(sheet.family, y), result)
        return result

    def factored(self, W: Scaling) -> Factor:
        """Return the factor of ``P + A'W^-2 A``.

        Raises:
            NoFactorError: it has none.
        """
        beside, corner = self.beside.copy(), self.corner.copy()
        squares = np.zeros((len(self.band), self.step, self.band.shape[1] // self.step))  # each knot's side by side
        for sheet in self.sheets:
            _add(sheet, W, squares, beside, corner)
        band = self.band + squares.swapaxes(1, 2).reshape(self.band.shape)
        for shift in SHIFTS:
            found = _factor(band, beside, corner, shift)
            if found is not None:
                return found
        raise NoFactorError


def _add(sheet: Sheet, W: Scaling, band: Array, beside: Array, corner: Array) -> None:
    """Add the squares of a sheet to the lower halves of band and corner, and to what is beside the band."""
    width, border = sheet.width, sheet.border - len(beside)
    for here, columns in sheet.squares(W):
        for j, column in enumerate(columns):
            if j < width:
                sheet.add_beside(j, column[: width - j], band[: width - j], here)
                for i, part in zip(border, column[width - j :], strict=True):
                    sheet.add(j, part, beside[:, i], here)
            else:
                corner[border[j - width :], border[j - width]] += column.sum(axis=1)


@dataclass(frozen=True)
class Factor:
    """The factor of the matrix."""

    band: Array  # (width, banded)
    beside: Array  # (banded, p)
    of_beside: Array  # (banded, p) B^-1 C
    corner: tuple[Array, bool]

    def solve(self, right: Array) -> Array:
        """Return x (n,) with ``(P + A'W^-2 A) x = right``."""
        nb = len(self.beside)
        inner = _banded(self.band, right[:nb])
        if not self.beside.shape[1]:
            return inner
        last = cho_solve(self.corner, right[nb:] - self.beside.T @ inner, check_finite=False)
        return np.concatenate([inner - self.of_beside @ last, last])


def _factor(band: Array, beside: Array, corner: Array, shift: float) -> Factor | None:
    lower = band
    if band.shape[1]:
        shifted = band.copy()
        shifted[0] += shift * np.where(band[0] > 0, band[0], 1.0)
        lower, failed = lapack.dpbtrf(shifted, lower=1, overwrite_ab=1)
        if failed or not np.isfinite(lower[0]).all():
            return None
    of_beside = _banded(lower, beside) if beside.size else beside
    schur = np.tril(corner) + np.tril(corner, -1).T - beside.T @ of_beside
    schur += shift * np.diag(np.where(corner.diagonal() > 0, corner.diagonal(), 1.0))
    try:
        return Factor(lower, beside, of_beside, cho_factor(schur, lower=True, check_finite=False))
    except np.linalg.LinAlgError:
        return None


def _banded(lower: Array, right: Array) -> Array:
    return np.asarray(lapack.dpbtrs(lower, right, lower=1)[0]) if lower.shape[1] else right
