"""A basis of the unknowns of all knots, stacked: orthogonal columns (T n_v, m), and what it makes of rows and sizes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from synergrip.linalg import Array

if TYPE_CHECKING:
    from scipy import sparse

SMALL = 4000
"""Entries of a matrix up to which it is written out, zeros and all, for a product."""
ROUNDING = 1e-12
"""An entry this small beside its row's largest, after a change of unknowns, is 0."""


def in_basis(rows: sparse.csc_matrix, basis: sparse.csc_matrix | None, extra: int) -> sparse.csc_matrix:
    """Return rows of the knots' unknowns as rows of the coefficients of a basis; `extra` columns after them stay."""
    if basis is None:
        return rows
    from scipy import sparse

    whole = sparse.block_diag([basis, sparse.eye_array(extra)], format="csc") if extra else basis
    size = abs(rows).max(axis=1).toarray().ravel() if rows.shape[0] else np.zeros(0)
    result = sparse.csc_matrix(rows @ whole)
    result.data[np.abs(result.data) <= ROUNDING * size[result.indices]] = 0.0
    result.eliminate_zeros()
    return result


def inverse(basis: sparse.csc_matrix) -> sparse.csr_matrix:
    """Return the pseudo-inverse (m, n) of orthogonal columns (n, m), none of them 0."""
    from scipy import sparse

    squared = np.asarray(basis.multiply(basis).sum(axis=0)).ravel()
    return sparse.csr_matrix(sparse.diags(1 / squared) @ basis.T)


def for_products(A: sparse.csc_matrix) -> sparse.csc_matrix | Array:
    """Return a matrix as it is multiplied fastest: a small one with its zeros."""
    return A.toarray() if A.shape[0] * A.shape[1] <= SMALL else A


def transposed_product(A: sparse.csc_matrix | Array, y: Array) -> Array:
    """Return ``A'y`` (n,) for y (m,); of a sparse A it takes longer to make A' than to multiply by it."""
    if isinstance(A, np.ndarray):
        return np.asarray(y @ A)
    columns = np.repeat(np.arange(A.shape[1]), np.diff(A.indptr))
    return np.asarray(np.bincount(columns, A.data * y[A.indices], A.shape[1]), dtype=np.float64)


def moves(basis: sparse.csc_matrix, matrix: Array) -> bool:
    """Return whether any of the columns changes ``matrix v_k`` at some knot, for a matrix (m, n_v)."""
    knot, unknown = np.divmod(basis.indices.astype(np.int64), matrix.shape[1])
    column = np.repeat(np.arange(basis.shape[1]), np.diff(basis.indptr))
    _, place = np.unique(knot * basis.shape[1] + column, return_inverse=True)
    pieces = np.zeros((int(place.max(initial=-1)) + 1, matrix.shape[1]))  # of a column at a knot, where it is not 0
    pieces[place, unknown] = basis.data
    size = np.abs(matrix).max(axis=1, initial=0.0)
    return bool(np.any(np.abs(pieces @ matrix.T) > ROUNDING * size))


def longest(basis: sparse.csc_matrix, n_v: int) -> int:
    """Return over how many knots the longest column reaches, from the first where it is not 0 to the last."""
    used = np.flatnonzero(np.diff(basis.indptr))
    knot = basis.indices // n_v
    if not len(used):
        return 1
    first, last = (each.reduceat(knot, basis.indptr[used]) for each in (np.minimum, np.maximum))
    return int((last - first).max()) + 1
