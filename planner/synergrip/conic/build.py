"""Limits and a goal, stacked into one sparse program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from synergrip.conic.box import LARGEST, box
from synergrip.conic.goals.goal import Goal, Squares
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Block, Program
from synergrip.conic.reserve import reserved
from synergrip.conic.rows import Kind, Rows
from synergrip.conic.situation import Situation
from synergrip.linalg import Array, frozen

Triplets = tuple[NDArray[np.intp], NDArray[np.intp], Array]


def build(situation: Situation, limits: Sequence[Limit], goal: Goal) -> Program:
    """Return the program that looks for the best plan by `goal` among those that keep all `limits`."""
    rows = [part for limit in limits for part in _rows(situation, limit, limit.couples_knots)]
    rows += _rows(situation, goal, couples_knots=False)
    cost = goal.objective(situation)
    extra = 0 if cost.epigraph is None else 1
    T, n_v = situation.knots, situation.n_v
    n, m = T * n_v + extra, sum(part.constant.size for part in rows)
    P, linear = _quadratic(cost.squares, T, n_v, n)
    A = _sparse([triplets for part, top in _tops(rows) for triplets in _entries(part, top, T, n - 1)], (m, n))
    q = linear if cost.epigraph is None else np.append(linear[:-1], cost.epigraph)
    b = np.concatenate([np.zeros(0), *(part.constant.ravel() for part in rows)])
    bounds = np.concatenate([np.tile(box(situation, limits), T), np.full(extra, LARGEST)])
    blocks = tuple(Block(p.limit, p.kind, p.dim, p.items, T - len(p.constant), len(p.constant)) for p in rows)
    return Program(P, frozen(q), A, frozen(b), blocks, T, n_v, frozen(bounds))


def _rows(situation: Situation, source: Limit | Goal, couples_knots: bool) -> Sequence[Rows]:
    """Return the rows of a limit or goal, with the reserve for what happens between the knots when it is asked for."""
    if situation.bend is None or couples_knots:
        return source.rows(situation)
    return reserved(source.rows, situation, situation.bend)


def _quadratic(squares: Sequence[Squares], knots: int, n_v: int, n: int) -> tuple[sparse.csc_matrix, Array]:
    """Return P (n, n) and q (n,) of half the sum of squares, constants left out."""
    P, q = sparse.csc_matrix((n, n)), np.zeros(n)
    for part in squares:
        if part.earlier:
            rows = Rows("", Kind.ZERO, 1, (), part.matrix, part.constant, np.zeros(len(part.matrix)), part.earlier)
            B = -_sparse(list(_entries(rows, 0, knots, n - 1)), (part.constant.size, n))
            P, q = P + (B.T @ B).tocsc(), q + B.T @ part.constant.ravel()
        else:  # one block for all knots
            P = P + _sparse([_repeated(part.matrix.T @ part.matrix, np.arange(knots), 0, 0)], (n, n))
            q[: knots * n_v] += (part.constant @ part.matrix).ravel()
    return P, q


def _tops(rows: Sequence[Rows]) -> Iterator[tuple[Rows, int]]:
    """Yield each contribution with its first row in the program."""
    top = 0
    for part in rows:
        yield part, top
        top += part.constant.size


def _entries(rows: Rows, top: int, knots: int, last: int) -> Iterator[Triplets]:
    """Yield the entries of A for one contribution: its value is ``b - A x``, hence the signs."""
    count = len(rows.constant)
    steps = np.arange(count)
    yield _repeated(-rows.matrix, steps, top, knots - count)
    for part in rows.earlier:
        yield _repeated(-part.matrix, steps, top, knots - count - part.lag, part.weights)
    used = np.flatnonzero(rows.epigraph)
    where = (top + steps[:, None] * len(rows.epigraph) + used).ravel()
    yield where, np.full(where.size, last), np.tile(-rows.epigraph[used], count)


def _repeated(matrix: Array, steps: NDArray[np.intp], top: int, first: int, weights: Array | None = None) -> Triplets:
    """Return the entries of one dense block repeated down the diagonal, from row `top` and knot `first` on.

    `weights` (len(steps),) multiply the copies.
    """
    i, j = np.nonzero(matrix)
    height, width = matrix.shape
    rows = top + steps[:, None] * height + i
    columns = (first + steps[:, None]) * width + j
    values = np.broadcast_to(matrix[i, j], rows.shape) if weights is None else weights[:, None] * matrix[i, j]
    return rows.ravel(), columns.ravel(), values.ravel()


def _sparse(entries: Sequence[Triplets], shape: tuple[int, int]) -> sparse.csc_matrix:
    if not entries:
        return sparse.csc_matrix(shape)
    rows, columns, values = (np.concatenate(column) for column in zip(*entries, strict=True))
    return sparse.csc_matrix((values, (rows.astype(np.intp), columns.astype(np.intp))), shape=shape)
