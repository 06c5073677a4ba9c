"""Rank, range and null space under one tolerance policy, and arrays that cannot be changed.

The policy (docs/theory.md): a singular value counts when it exceeds `RANK_TOLERANCE`
times the largest; between `GREY_FLOOR` and `GREY_CEILING` the decision is flagged as ambiguous,
because a change of the data in the last printed digits could turn it.
Matrices are made free of units before they come here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

RANK_TOLERANCE = 1e-8
GREY_FLOOR = 1e-11
GREY_CEILING = 1e-5
SINGULAR = 1e-13
"""A symmetric matrix with unit diagonal is singular when its smallest eigenvalue is below this."""


def frozen(values: object, shape: tuple[int, ...] | None = None) -> Array:
    """Return a read-only float64 copy of `values`, reshaped to `shape` when given."""
    array = np.array(values, dtype=np.float64)
    if shape is not None:
        array = array.reshape(shape)
    array.setflags(write=False)
    return array


@dataclass(frozen=True)
class Decision:
    """A rank decision together with what it was based on."""

    rank: int
    singular_values: Array  # relative to `reference`, descending
    ambiguous: bool

    @classmethod
    def of(cls, singular_values: Array, reference: float) -> Decision:
        """Decide by the policy; `reference` is the size that counts as 1."""
        relative = np.asarray(singular_values) / reference if reference > 0 else np.zeros(len(singular_values))
        grey = (relative > GREY_FLOOR) & (relative < GREY_CEILING)
        return cls(int(np.sum(relative > RANK_TOLERANCE)), frozen(relative), bool(np.any(grey)))


@dataclass(frozen=True)
class Split:
    """The row space and the null space of a matrix, as orthonormal columns."""

    row_space: Array
    null_space: Array
    decision: Decision


def split(matrix: Array, reference: float | None = None) -> Split:
    """Split the domain of `matrix` (m, n) into row space (n, r) and null space (n, n - r).

    `reference` is the singular value that counts as 1 (default: the largest of the matrix).
    """
    rows, columns = matrix.shape
    if rows == 0 or columns == 0:
        return Split(np.zeros((columns, 0)), np.eye(columns), Decision.of(np.zeros(0), 1.0))
    _, values, transposed = np.linalg.svd(matrix, full_matrices=True)
    padded = np.concatenate([values, np.zeros(max(columns - len(values), 0))])[:columns]
    decision = Decision.of(padded, float(values[0]) if reference is None else reference)
    return Split(transposed[: decision.rank].T, transposed[decision.rank :].T, decision)


def canonical(basis: Array) -> Array:
    """Return the orthonormal basis of the same subspace that depends on nothing but the subspace.

    Columns are taken greedily from the projector (largest remaining column, the first among
    equals), orthonormalised in that order, with the largest entry of each made positive. A
    subspace spanned by coordinate axes comes back as those axes.
    """
    size, dimension = basis.shape
    if dimension == 0:
        return frozen(np.zeros((size, 0)))
    remaining = np.linalg.qr(basis)[0]
    columns = []
    for _ in range(dimension):
        lengths = np.linalg.norm(remaining, axis=1)  # column norms of the projector
        pick = int(np.argmax(lengths > lengths.max() - 1e-9))
        direction = remaining[pick] / lengths[pick]
        columns.append(remaining @ direction)
        if remaining.shape[1] > 1:  # the part of the subspace orthogonal to the new column
            complement = np.linalg.svd(direction[None, :], full_matrices=True)[2][1:].T
            remaining = remaining @ complement
    result = np.linalg.qr(np.column_stack(columns))[0]
    largest = np.argmax(np.abs(result) > np.abs(result).max(axis=0) - 1e-9, axis=0)
    return frozen(result * np.where(result[largest, range(dimension)] < 0, -1.0, 1.0))


def interpolated(times: Array, known: Array, values: Array) -> Array:
    """Return `values` (K, m), given at `known` (K,), at `times` (T,): shape (T, m), linear in between."""
    result = np.zeros((len(times), values.shape[1]))
    for i, column in enumerate(values.T):
        result[:, i] = np.interp(times, known, column)
    return result


def block_diagonal(blocks: Sequence[Array]) -> Array:
    """Return the dense block-diagonal matrix of `blocks`."""
    result = np.zeros((sum(b.shape[0] for b in blocks), sum(b.shape[1] for b in blocks)))
    row = column = 0
    for block in blocks:
        result[row : row + block.shape[0], column : column + block.shape[1]] = block
        row, column = row + block.shape[0], column + block.shape[1]
    return result


def cross(v: Array) -> Array:
    """Return the skew matrix (3, 3) of a vector (3,): ``cross(v) @ u`` is v x u."""
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
