"""Rank, range and null space under one tolerance policy, and arrays that cannot be changed.

The policy (docs/theory.md): a singular value counts when it exceeds `RANK_TOLERANCE`
times the largest; between `GREY_FLOOR` and `GREY_CEILING` the decision is flagged as ambiguous,
because a change of the data in the last printed digits could turn it.
Matrices are made free of units before they come here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.values import Value

Array = NDArray[np.float64]
Places = NDArray[np.int64]
"""Whole numbers: places in a stack, or ranks."""

RANK_TOLERANCE = 1e-8
GREY_FLOOR = 1e-11
GREY_CEILING = 1e-5
CLEAR = 1e-2
"""Singular values above this share of the largest are in no danger of counting as 0."""
SINGULAR = 1e-13
"""A symmetric matrix with unit diagonal is singular when its smallest eigenvalue is below this."""


def frozen(values: object, shape: tuple[int, ...] | None = None) -> Array:
    """Return a read-only float64 copy of `values`, reshaped to `shape` when given."""
    array = np.array(values, dtype=np.float64)
    if shape is not None:
        array = array.reshape(shape)
    array.setflags(write=False)
    return array


def sealed(made: Array) -> Array:
    """Return an array that was just made, and that nobody else has, read-only: as `frozen`, without a copy."""
    made.setflags(write=False)
    return made


def largest_size(values: Array) -> float:
    """Return the largest absolute value of an array; 0 of an empty one."""
    return float(np.abs(values).max(initial=0.0))


@dataclass(frozen=True, eq=False, repr=False)
class Decision(Value):
    """A rank decision together with what it was based on."""

    rank: int
    singular_values: Array  # relative to `reference`, descending
    ambiguous: bool

    @classmethod
    def of(cls, singular_values: Array, reference: float) -> Decision:
        """Decide by the policy; `reference` is the size that counts as 1."""
        return Decisions.of(np.asarray(singular_values), np.asarray(reference)).at(())


@dataclass(frozen=True, eq=False, repr=False)
class Decisions(Value):
    """The rank decisions on the matrices of a stack: leading axes (...), those of `Decision` for each matrix."""

    ranks: Places  # (...)
    singular_values: Array  # (..., k) relative to the reference of each, descending
    ambiguous: NDArray[np.bool_]  # (...)

    @classmethod
    def of(cls, singular_values: Array, references: Array) -> Decisions:
        """Decide by the policy on values (..., k); `references` (...) are the sizes that count as 1."""
        sizes = references[..., None]
        relative = np.where(sizes > 0, singular_values / np.where(sizes > 0, sizes, 1.0), 0.0)
        grey = (relative > GREY_FLOOR) & (relative < GREY_CEILING)
        return cls(np.sum(relative > RANK_TOLERANCE, axis=-1), relative, np.any(grey, axis=-1))

    def at(self, place: Any) -> Decision:
        """Return the decision on one matrix of the stack."""
        return Decision(int(self.ranks[place]), frozen(self.singular_values[place]), bool(self.ambiguous[place]))

    def taken(self, places: Any) -> Decisions:
        """Return the decisions on those matrices of the stack."""
        return Decisions(self.ranks[places], self.singular_values[places], self.ambiguous[places])


@dataclass(frozen=True, eq=False, repr=False)
class Split(Value):
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
    decision = Decision.of(_padded(values, columns), float(values[0]) if reference is None else reference)
    return Split(transposed[: decision.rank].T, transposed[decision.rank :].T, decision)


def null_spaces(matrices: Array, references: Array | None = None) -> Array:
    """Return directions (..., n, n) that are those of the null spaces of matrices (..., m, n), and 0 for the others.

    Columns that are not 0 are orthonormal; ranks are decided as `split` does, with the singular values `references`
    (...) that count as 1 (default: the largest of each matrix).
    """
    rows, columns = matrices.shape[-2:]
    if rows == 0 or columns == 0:
        return np.broadcast_to(np.eye(columns), (*matrices.shape[:-2], columns, columns))
    _, values, transposed = np.linalg.svd(matrices, full_matrices=rows < columns)
    ranks = Decisions.of(_padded(values, columns), values[..., 0] if references is None else references).ranks
    return np.asarray(transposed * (np.arange(columns) >= ranks[..., None])[..., None]).mT


def decided(matrices: Array, references: Array | None = None) -> Decisions:
    """Return what `split` decides of the ranks of matrices (..., m, n), without the spaces.

    `references` (...) are the singular values that count as 1 (default: the largest of each matrix).
    """
    values = singular_values(matrices)
    return Decisions.of(values, values.max(axis=-1, initial=0.0) if references is None else references)


def singular_values(matrices: Array) -> Array:
    """Return the n singular values (..., n) of matrices (..., m, n), descending; 0 where m is less than n."""
    values, clear = _from_squares(matrices)
    if matrices.size and not np.all(clear):
        values[~clear] = np.linalg.svd(matrices[~clear], compute_uv=False)
    return _padded(values, matrices.shape[-1])


def right_singular(matrices: Array, references: Array) -> tuple[Array, Array]:
    """Return the n singular values (..., n) of matrices (..., m, n), and directions as orthonormal columns (..., n, n).

    Directions are those of the singular values where one of these is small beside `references` (...). Elsewhere the
    rank is the smaller of m and n, and all that is told apart is the null space: the last columns, where m is less.
    """
    rows, columns = matrices.shape[-2:]
    values, clear = _from_squares(matrices)
    clear &= values.min(axis=-1, initial=np.inf) > CLEAR * references
    directions = np.zeros((*matrices.shape[:-2], columns, columns))
    if 0 < rows < columns:
        directions[clear] = np.linalg.qr(matrices[clear].mT, mode="complete")[0]
    else:
        directions[..., range(columns), range(columns)] = 1.0
    if matrices.size and not np.all(clear):
        _, own, transposed = np.linalg.svd(matrices[~clear], full_matrices=rows < columns)
        values[~clear], directions[~clear] = own, transposed.mT
    return _padded(values, columns), directions


def left_singular(matrices: Array, rank: int) -> tuple[Array, Array]:
    """Return the singular values (..., min(m, n)) of matrices (..., m, n), and the space of the first `rank`.

    Columns (..., m, rank) span it; they are the matrix's own where all its columns count and are far from dependent.
    """
    values, clear = _from_squares(matrices)
    clear &= rank == matrices.shape[-1]
    spanning = np.array(matrices[..., :rank])
    if matrices.size and not np.all(clear):
        vectors, own, _ = np.linalg.svd(matrices[~clear], full_matrices=False)
        values[~clear], spanning[~clear] = own, vectors[..., :rank]
    return values, spanning


def _from_squares(matrices: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return singular values (..., min(m, n)) as roots of eigenvalues of ``A' A`` or ``A A'``, and where these do.

    Several times as fast as the singular values themselves, and as good to 1e-14 of the largest, unless the smallest
    is small beside it.
    """
    *leading, rows, columns = matrices.shape
    if min(rows, columns) == 0:
        return np.zeros((*leading, 0)), np.full(leading, True)
    squares = np.linalg.eigvalsh(gram(matrices.mT if rows < columns else matrices))[..., ::-1]
    clear = squares[..., -1] > CLEAR**2 * squares[..., 0]
    return np.sqrt(np.maximum(squares, 0.0)), np.array(clear)


def inverse_of(matrices: Array) -> Array:
    """Return the inverses of matrices (..., n, n); the pseudo-inverses of all where one has none."""
    try:
        return np.asarray(np.linalg.inv(matrices))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(matrices))


def gram(matrices: Array) -> Array:
    """Return ``A' A`` for matrices A (..., m, n)."""
    return np.asarray(matrices.mT @ matrices.copy())  # seeing a small A itself twice, NumPy takes longer


def _padded(values: Array, columns: int) -> Array:
    """Return singular values (..., k) with a 0 for each of the `columns` that there is none for."""
    if values.shape[-1] >= columns:
        return values
    return np.concatenate([values, np.zeros((*values.shape[:-1], columns - values.shape[-1]))], axis=-1)


def canonical(basis: Array) -> Array:
    """Return the orthonormal basis of the same subspace that depends on nothing but the subspace.

    Columns are taken greedily from the projector (largest remaining column, the first among
    equals), orthonormalised in that order, with the largest entry of each made positive. A
    subspace spanned by coordinate axes comes back as those axes.

    Args:
        basis: (..., n, k) of a subspace, or of each of a stack.
    """
    *leading, size, dimension = basis.shape
    if dimension == 0:
        return frozen(np.zeros(basis.shape))
    own = np.linalg.qr(basis.reshape(-1, size, dimension))[0]
    stack, turns = np.arange(len(own)), np.zeros((len(own), dimension, dimension))
    columns = np.zeros((len(own), dimension, size))
    squares = np.sum(own**2, axis=-1)  # of the column norms of the projector
    for k in range(dimension):
        pick = np.argmax(squares > (np.sqrt(squares.max(axis=-1, keepdims=True)) - 1e-9) ** 2, axis=-1)
        rest = own[stack, pick] - (columns[stack, None, :k, pick] @ turns[:, :k])[:, 0]
        turns[:, k] = rest / np.sqrt(np.sum(rest**2, axis=-1, keepdims=True))
        columns[:, k] = (own @ turns[:, k, :, None])[..., 0]
        squares -= columns[:, k] ** 2  # what is orthogonal to the new column remains
    columns = 1.5 * columns - 0.5 * (columns @ columns.mT) @ columns  # what is left of 1e-15 is 1e-30
    sizes = np.abs(columns)
    largest = np.argmax(sizes > sizes.max(axis=-1, keepdims=True) - 1e-9, axis=-1)
    negative = np.take_along_axis(columns, largest[..., None], axis=-1) < 0
    return frozen(np.where(negative, -columns, columns).mT, (*leading, size, dimension))


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
