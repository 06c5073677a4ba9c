"""Rows that are alike at every knot, written straight into one sparse matrix: no entry is kept twice on the way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic.rows import Earlier
from synergrip.linalg import Array

ROUNDING = 1e-15
"""Entries this small beside the largest of their row are what rounding left of zeros; a solver would pay for them."""


@dataclass(frozen=True)
class Band:
    """The rows of one knot, which repeat down the diagonal: ``matrix v_k``, earlier knots' parts, and the scalar's."""

    matrix: Array  # (h, n_v), or (T, h, n_v) with one for each knot
    earlier: tuple[Earlier, ...]
    scalar: Array
    """(h,) entries in the last column, that of the goal's scalar."""
    count: int
    """How often it repeats; the last copy belongs to the last knot."""
    exact: bool = False
    """Whether small entries are no rounding, and stay; of bands below one another all or none."""


@dataclass(frozen=True)
class _Part:
    """What the copies of a band say of knots: the same entries again and again, each copy's times its weight."""

    first_knot: int
    """The one that the first copy speaks of; the others follow."""
    weights: Array  # (count,)
    first_row: int
    height: int
    """Rows of a copy."""
    row: NDArray[np.intp]  # (e,) within the copy, ascending
    column: NDArray[np.intp]  # (e,) within the knot
    value: Array  # (e,), or (count, e) when they differ from copy to copy

    @property
    def knots(self) -> tuple[int, int]:
        """The first knot it speaks of, and the one after the last."""
        return self.first_knot, self.first_knot + len(self.weights)


def stacked(bands: Sequence[Band], knots: int, n_v: int, extra: int) -> sparse.csc_matrix:
    """Return the bands below one another.

    Args:
        bands: (h, n_v) each.
        knots: number of knots T.
        n_v: unknowns of a knot.
        extra: columns beyond those of the knots: 1 with a scalar, else 0.
    """
    if knots == 1 and not any(band.earlier for band in bands):
        return _of_one_knot(bands, n_v, extra)
    tops = np.cumsum([0, *(band.matrix.shape[-2] * band.count for band in bands)])
    placed = list(zip(bands, tops.tolist(), strict=False))
    parts = [part for band, top in placed for part in _parts(band, top, knots)]
    scalars = [_scalar_column(band, top) for band, top in placed] if extra else []
    total = sum(part.row.size * len(part.weights) for part in parts) + sum(len(rows) for rows, _ in scalars)
    index: type[np.int32 | np.int64] = np.int32 if max(total, tops[-1]) < 2**31 else np.int64
    lengths = np.zeros(knots * n_v + extra, dtype=index)
    data, indices = np.empty(total), np.empty(total, dtype=index)
    at = 0
    for first, last in pairwise(sorted({0, knots, *(end for part in parts for end in part.knots)})):
        there = [part for part in parts if part.knots[0] <= first and last <= part.knots[1]]
        shape = last - first, sum(part.row.size for part in there)
        here = slice(at, at + shape[0] * shape[1])
        one = _fill(there, first, n_v, data[here].reshape(shape), indices[here].reshape(shape))
        lengths[first * n_v : last * n_v] = np.tile(one, last - first)
        at = here.stop
    for rows, values in scalars:
        indices[at : at + len(rows)], data[at : at + len(rows)] = rows, values
        lengths[-1] += len(rows)
        at += len(rows)
    ends = np.concatenate([np.zeros(1, dtype=index), np.cumsum(lengths, dtype=index)])
    return sparse.csc_matrix((data, indices, ends), shape=(int(tops[-1]), len(lengths)))


def _of_one_knot(bands: Sequence[Band], n_v: int, extra: int) -> sparse.csc_matrix:
    """Return the bands below one another where there is nothing to repeat."""
    whole = np.zeros((sum(band.matrix.shape[-2] for band in bands), n_v + extra))
    top = 0
    for band in bands:
        rows = slice(top, top := top + band.matrix.shape[-2])
        whole[rows, :n_v] = band.matrix if band.matrix.ndim == 2 else band.matrix[0]
        if extra:
            whole[rows, n_v] = band.scalar
    size = np.abs(whole)
    rounding = 0.0 if any(band.exact for band in bands) else ROUNDING * _largest_of_rows(size[:, :n_v])
    column, row = np.nonzero((size > rounding).T)
    ends = np.searchsorted(column, np.arange(n_v + extra + 1)).astype(np.int32)
    return sparse.csc_matrix((whole[row, column], row.astype(np.int32), ends), shape=whole.shape)


def _parts(band: Band, top: int, knots: int) -> list[_Part]:
    """Return what a band says of its own knots, and of those before them."""
    height, first = band.matrix.shape[-2], knots - band.count
    result = []
    for part in (Earlier(0, band.matrix, np.ones(band.count)), *sorted(band.earlier, key=lambda part: part.lag)):
        entries = part.matrix if band.exact else without_rounding(part.matrix)
        row, column = np.nonzero(entries if entries.ndim == 2 else entries.any(axis=0))
        value = entries[..., row, column]
        if value.ndim > 1:
            value = value[first - part.lag : first - part.lag + band.count]
        result.append(_Part(first - part.lag, part.weights, top, height, row, column, value))
    return result


def without_rounding(matrix: Array) -> Array:
    """Return the matrix with 0 where an entry is rounding beside the largest of its row."""
    size = np.abs(matrix)
    return np.where(size > ROUNDING * _largest_of_rows(size), matrix, 0.0)


def _largest_of_rows(size: Array) -> Array:
    return np.asarray(size.max(axis=-1, keepdims=True, initial=0.0))


def _scalar_column(band: Band, top: int) -> tuple[NDArray[np.intp], Array]:
    used = np.flatnonzero(band.scalar)
    rows = top + np.arange(band.count)[:, None] * len(band.scalar) + used
    return rows.ravel(), np.tile(band.scalar[used], band.count)


def _fill(
    parts: Sequence[_Part], first: int, n_v: int, data: Array, indices: NDArray[np.signedinteger]
) -> NDArray[np.intp]:
    """Write the columns of all knots from `first` on, (knots, entries of one), and return their lengths (n_v,)."""
    column = np.concatenate([np.zeros(0, dtype=np.intp), *(part.column for part in parts)])
    place = np.argsort(np.argsort(column, kind="stable"))  # parts come in the order of their rows
    start = 0
    for part in parts:
        where = place[start : start + len(part.column)]
        copies = np.arange(len(data)) + first - part.first_knot
        data[:, where] = part.weights[copies, None] * (part.value if part.value.ndim == 1 else part.value[copies])
        indices[:, where] = part.first_row + copies[:, None] * part.height + part.row
        start += len(part.column)
    return np.bincount(column, minlength=n_v)
