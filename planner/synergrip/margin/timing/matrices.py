"""Sparse matrices of the program of a timing, all of one type."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy import sparse

from synergrip.linalg import Array

Sparse = sparse.csr_matrix


def eye(size: int) -> Sparse:
    """Return the identity."""
    return sparse.csr_matrix(sparse.eye_array(size))


def empty(rows: int, columns: int) -> Sparse:
    """Return zeros."""
    return sparse.csr_matrix((rows, columns))


def scaled(factors: Array, matrix: Any) -> Sparse:
    """Return a matrix with its rows times factors."""
    return sparse.csr_matrix(sparse.diags_array(factors) @ matrix)


def beside(*parts: Sparse) -> Sparse:
    """Return matrices side by side."""
    return sparse.csr_matrix(sparse.hstack(parts))


def below(parts: Sequence[Sparse]) -> Sparse:
    """Return matrices below one another."""
    return sparse.csr_matrix(sparse.vstack(parts))


def interleaved(parts: Sequence[Sparse]) -> Sparse:
    """Return the first rows of all parts, then the second ones, and so on."""
    count, height = len(parts), int(parts[0].shape[0])
    order = np.arange(count * height).reshape(count, height).T.ravel()
    return sparse.csr_matrix(below(parts)[order])


def ends(parts: int) -> tuple[Sparse, Sparse]:
    """Return (n, n + 1) twice: of values at grid points those at the start of each part, and those at its end."""
    whole = eye(parts + 1)
    return sparse.csr_matrix(whole[:-1]), sparse.csr_matrix(whole[1:])
