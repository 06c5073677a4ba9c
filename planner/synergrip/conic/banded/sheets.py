"""The rows of a family of cones, each knot's dense in the few neighbouring unknowns that they touch.

A sheet adds ``A'W^-2 A`` of its rows to the matrix of the knots: a small square for each knot, on the diagonal. Where
the rows are the same at all knots, squares of rows are worked out once, and those of all knots are one product of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import as_strided
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic import cone_algebra as cone
from synergrip.conic.banded.columns import Columns
from synergrip.conic.banded.cones import Family, Scaling
from synergrip.linalg import Array

CHUNK = 1 << 16
"""Entries that are worked on at a time: they stay in the processor's cache."""
ALIKE = 1e-11
"""Share of the largest entry by which rows at different knots may differ and still are the same: the rounding of times
of equal steps."""


@dataclass(frozen=True)
class Sheet:
    """The rows of a family."""

    family: Family
    rows: Array
    """(K, items, size, width + border), or (1, ...) when they are the same at all knots."""
    starts: NDArray[np.intp]  # (K,) the first unknown of each
    border: NDArray[np.intp]
    """Unknowns that the last columns are of, which all knots share."""

    @classmethod
    def of(cls, A: sparse.csr_matrix, columns: Columns, family: Family) -> Sheet:
        """Return the sheet of a family in a matrix whose unknowns are in the order of the columns, sorted."""
        own = A[family.rows.ravel()]
        row = np.repeat(np.arange(own.shape[0]), np.diff(own.indptr))
        indices = own.indices.astype(np.intp)
        inside = indices < columns.banded
        used = np.unique(indices[~inside])
        knot, within = np.divmod(row, family.rows.shape[1])
        starts, width = _windows(indices[inside], knot[inside], columns, family.knots)
        dense = np.zeros((family.knots, family.rows.shape[1], width + len(used)))
        column = np.where(inside, indices - starts[knot], width + np.searchsorted(used, indices))
        dense[knot, within, column] = own.data
        room = ALIKE * float(np.abs(dense).max(initial=0.0))
        if np.all(np.abs(dense[-1] - dense[0]) <= room) and np.all(np.abs(dense - dense[0]) <= room):
            dense = dense[:1].copy()
        return cls(family, dense.reshape(len(dense), family.items, family.size, -1), starts, used)

    @property
    def width(self) -> int:
        """Of the part in the band."""
        return int(self.rows.shape[3]) - len(self.border)

    @cached_property
    def step(self) -> int:
        """How far the windows of two knots are apart when it is always the same and not 0; else 0."""
        steps = np.diff(self.starts)
        alike = len(steps) > 0 and steps[0] > 0 and bool(np.all(steps == steps[0]))
        return int(steps[0]) if alike else int(len(self.starts) == 1)

    def times(self, x: Array, result: Array) -> None:
        """Write the values of the rows at unknowns x (n,) into a result (size, K, items)."""
        windows = self._windows(x)
        for k, out in enumerate(result):
            rows = self.rows[:, :, k, : self.width]
            if self._alike:
                np.matmul(windows, rows[0].T, out=out)
            else:
                np.einsum("kiw,kw->ki", rows, windows, out=out)
            if len(self.border):
                out += self.rows[:, :, k, self.width :] @ x[self.border]

    def add_back(self, values: Array, result: Array) -> None:
        """Add to a result (n,) what the transposed rows make of values (size, K, items)."""
        if self._alike:
            back = sum(self.rows[0, :, k].T @ part.T for k, part in enumerate(values))
        else:
            back = sum(np.einsum("kiw,ki->wk", self.rows[:, :, k], part) for k, part in enumerate(values))
        for j, part in enumerate(back[: self.width]):
            self.add(j, part, result)
        result[self.border] += back[self.width :].sum(axis=1)

    def add(self, j: int, part: Array, result: Array, here: slice = slice(None)) -> None:
        """Add values (K,) to a result (banded,) at the j-th unknown of each window, of all knots or of some."""
        starts = self.starts[here]
        if self.step:
            result[starts[0] + j : starts[-1] + j + 1 : self.step] += part
        else:
            np.add.at(result, starts + j, part)

    def add_beside(self, j: int, part: Array, result: Array, here: slice) -> None:
        """Add values (..., K) as `add` does to a result (..., s, banded / s) that has every s-th unknown together."""
        stride, starts = result.shape[-2], self.starts[here] + j
        if self.step and self.step % stride == 0:
            first, last = starts[0] // stride, starts[-1] // stride
            result[..., starts[0] % stride, first : last + 1 : max(self.step // stride, 1)] += part
        else:
            where: Any = (..., starts % stride, starts // stride)
            np.add.at(result, where, part)

    def squares(self, W: Scaling) -> Iterator[tuple[slice, list[Array]]]:
        """Yield for some of the knots at a time their squares: of each column what is on the diagonal and below it.

        The j-th of these is (width + border - j, knots).
        """
        family, lane = self.family, self.family.lane
        end = family.first + family.knots * family.items
        v = W.v[lane][family.first : end].reshape(family.knots, family.items, -1)
        beta = W.beta[lane][family.first : end].reshape(family.knots, -1)
        for here in self._chunks():
            yield here, (self._alike_squares if self._alike else self._own_squares)(v[here], beta[here], here)

    def _chunks(self) -> Iterator[slice]:
        one = max(self.rows[0].size, self.rows.shape[3] ** 2, 1)
        some, knots = max(1, CHUNK // one), self.family.knots
        return (slice(start, min(start + some, knots)) for start in range(0, knots, some))

    def _alike_squares(self, v: Array, beta: Array, _: slice) -> list[Array]:
        """Return those of rows that are the same: weights of the squares of rows, times these."""
        if self.family.size == 1:
            weights = (1 / beta**2).T
        else:
            weights = np.moveaxis(cone.squared_inverse(v, beta), 1, 2).reshape(-1, len(v))  # (pairs x items, K)
        wide = self.rows.shape[3]
        return np.split(self._outer @ weights, np.cumsum(np.arange(wide, 1, -1)))[:wide]

    @cached_property
    def _outer(self) -> Array:
        """(pairs, pairs of rows in a cone x items) products of two rows, those of two different ones both ways."""
        j, i = np.triu_indices(self.rows.shape[3])  # column after column
        parts = []
        for a, b in zip(*np.tril_indices(self.family.size), strict=True):
            one, other = self.rows[0, :, a], self.rows[0, :, b]
            both = one[:, i] * other[:, j]
            parts.append(both if a == b else both + one[:, j] * other[:, i])
        return np.concatenate(parts).T.copy()

    def _own_squares(self, v: Array, beta: Array, here: slice) -> list[Array]:
        """Return those of rows that are each knot's own."""
        rows = self.rows[here]
        scaled = rows / beta[..., None, None] if self.family.size == 1 else cone.unscaled_rows(v, beta, rows)
        flat = scaled.reshape(len(rows), -1, rows.shape[3])
        whole = np.moveaxis(flat.mT @ flat, 0, 2)
        return [whole[j:, j] for j in range(len(whole))]

    def _windows(self, x: Array) -> Array:
        """Return what the rows of each knot look at (K, width)."""
        if not self.step:
            return np.asarray(x[self.starts[:, None] + np.arange(self.width)])
        begin, unit = x[self.starts[0] :], x.strides[0]
        return as_strided(begin, (len(self.starts), self.width), (self.step * unit, unit), writeable=False)

    @property
    def _alike(self) -> bool:
        return len(self.rows) == 1 < self.family.knots


def _windows(
    column: NDArray[np.intp], knot: NDArray[np.intp], columns: Columns, knots: int
) -> tuple[NDArray[np.intp], int]:
    """Return the first unknown of each knot's rows (K,), and how many they touch at most, of entries by knot."""
    begins = np.searchsorted(knot, np.arange(knots + 1))
    filled = np.flatnonzero(np.diff(begins))
    first, width = np.zeros(knots, dtype=np.intp), 0
    if len(filled):
        first[filled] = np.minimum.reduceat(column, begins[filled])
        first[filled] -= first[filled] % columns.step
        width = int((np.maximum.reduceat(column, begins[filled]) + 1 - first[filled]).max())
        first = first[filled[np.maximum(np.searchsorted(filled, np.arange(knots), side="right") - 1, 0)]]
    return np.minimum(first, columns.banded - width), width
