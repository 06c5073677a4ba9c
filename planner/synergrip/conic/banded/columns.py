"""The order of a program's unknowns in which its cones touch few neighbouring ones: knot after knot.

What speaks of the whole trajectory comes last, as a border: the goal's scalar, a course in time that a basis has.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic.program import Program

SPAN = 8
"""Knots that a column of a basis may move and still is no border."""


@dataclass(frozen=True)
class Columns:
    """The unknowns in their new order, the banded ones first."""

    order: NDArray[np.intp]  # (n,)
    banded: int
    step: int
    """Unknowns of a knot, when those are the banded ones, in their order; 1 when a basis mixes them."""

    @classmethod
    def of(cls, program: Program) -> Columns:
        """Return the order for a program."""
        n, n_v = len(program.q), program.n_v
        if program.basis is None:
            return cls(np.arange(n), program.knots * n_v, n_v)
        first, last = _touched(program.basis, n_v)
        banded = last - first < SPAN
        places = np.concatenate([np.flatnonzero(banded)[np.argsort(first[banded], kind="stable")],
                                 np.flatnonzero(~banded), np.arange(len(first), n)])  # fmt: skip
        return cls(places, int(banded.sum()), 1)

    def ordered(self, matrix: sparse.csc_matrix) -> sparse.csr_matrix:
        """Return a matrix (m, n) with its columns in this order."""
        kept = np.array_equal(self.order, np.arange(len(self.order)))
        return sparse.csr_matrix(matrix if kept else sparse.csc_matrix(matrix)[:, self.order]).sorted_indices()


def _touched(basis: sparse.csc_matrix, n_v: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the first and the last knot that each column of a basis moves."""
    basis = basis.sorted_indices()
    filled = np.diff(basis.indptr) > 0
    first, last = np.zeros(basis.shape[1], dtype=np.intp), np.zeros(basis.shape[1], dtype=np.intp)
    first[filled] = basis.indices[basis.indptr[:-1][filled]] // n_v
    last[filled] = basis.indices[basis.indptr[1:][filled] - 1] // n_v
    return first, last
