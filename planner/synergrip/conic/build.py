"""Limits and a goal, stacked into one sparse program."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
from scipy import sparse

from synergrip.conic.affine import times
from synergrip.conic.allowed import in_all_cases
from synergrip.conic.assembly import Band, stacked, without_rounding
from synergrip.conic.basis import in_basis, inverse
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Block, Program
from synergrip.conic.reserve import Reserve
from synergrip.conic.rows import Rows
from synergrip.conic.variable_bounds import farthest, variable_bounds
from synergrip.linalg import Array, frozen, gram, sealed
from synergrip.values import Value


def build(formulation: Formulation, limits: Sequence[Limit], goal: Goal, worth: float = 1.0) -> Program:
    """Return the program that looks for the best plan by `goal` among those that keep all `limits`.

    Sums of squares are divided by `worth`.
    """
    cost = goal.objective(formulation)
    extra = 0 if cost.epigraph is None else 1
    asked = _constraints(formulation, limits, goal, extra)
    T, n_v, basis = formulation.knots, formulation.n_v, formulation.free_basis
    worth = worth if extra else worth * formulation.divisor
    P, linear = _quadratic(cost.squares, T, n_v, extra, basis)
    if P.data.size:
        P.data, linear = P.data / worth, linear / worth
    if cost.epigraph is not None:
        linear[-1] = cost.epigraph
    box, constant = partial(_box, formulation, tuple(limits), extra), _constant(cost) / worth
    return Program(P, sealed(linear), asked.A, asked.b, asked.blocks, T, n_v, box, basis, constant)


def _box(formulation: Formulation, limits: Sequence[Limit], extra: int) -> Array:
    """Return the `variable_bounds` of the program."""
    T, n_v, basis = formulation.knots, formulation.n_v, formulation.free_basis
    bounds = variable_bounds(formulation, limits)
    bounds = bounds.ravel() if bounds.size == T * n_v else np.tile(bounds, T)
    if basis is not None:
        bounds = np.asarray(abs(inverse(basis)) @ bounds)
    return frozen(np.append(bounds, farthest(formulation)) if extra else bounds)


@dataclass(frozen=True, eq=False, repr=False)
class Constraints(Value):
    """What a program asks of its unknowns: ``b - A x`` in the cones of blocks."""

    A: sparse.csc_matrix  # (m, n)
    b: Array  # (m,)
    blocks: tuple[Block, ...]


def constraints(formulation: Formulation, limits: Sequence[Limit], goal: Goal) -> Constraints:
    """Return the rows of the program that looks for the best plan by `goal` among those that keep all `limits`."""
    return _constraints(formulation, limits, goal, 0 if goal.objective(formulation).epigraph is None else 1)


def _constraints(formulation: Formulation, limits: Sequence[Limit], goal: Goal, extra: int) -> Constraints:
    rows, T = _rows(formulation, limits, goal), formulation.knots
    A = in_basis(_matrix(rows, T, formulation.n_v, extra), formulation.free_basis, extra)
    np.negative(A.data, out=A.data)  # the value of a row is b - A x
    b = np.concatenate([np.zeros(0), *(_constants(part) for part in rows)])
    return Constraints(A, sealed(b), tuple(_block(part, T) for part in rows))


def _constant(cost: Objective) -> float:
    return sum(float((part.constant**2).sum()) / 2 for part in cost.squares)


def _matrix(rows: Sequence[Rows], knots: int, n_v: int, extra: int) -> sparse.csc_matrix:
    """Return the matrix of rows, those at the knots before those between them."""
    at = [part for part in rows if part.inside is None]
    bands = [Band(part.matrix, part.earlier, part.epigraph, len(part.constant)) for part in at]
    A = stacked(bands, knots, n_v, extra)
    between = [_between(part, part.inside, extra) for part in rows if part.inside is not None]
    return sparse.csc_matrix(sparse.vstack([A, *between])) if between else A


def _between(rows: Rows, shares: sparse.csr_matrix, extra: int) -> sparse.csc_matrix:
    """Return the matrix of rows at instants (K,) that have `shares` (K, T) of the knots."""
    matrix = without_rounding(rows.matrix)
    if matrix.ndim == 2:
        body = sparse.kron(shares, sparse.csr_matrix(matrix))
    else:
        of_knots = sparse.block_diag([sparse.csr_matrix(each) for each in matrix], format="csr")
        body = sparse.kron(shares, sparse.eye_array(matrix.shape[1], format="csr"), format="csr") @ of_knots
    scalar = sparse.csr_matrix(np.tile(rows.epigraph, len(rows.constant))[:, None])
    whole = sparse.hstack([body, scalar]) if extra else body
    return sparse.csc_matrix(whole) if rows.over_time is None else _over_time(sparse.csr_matrix(whole), len(rows.items))


def _over_time(body: sparse.csr_matrix, items: int) -> sparse.csc_matrix:
    """Return rows (instants, items) as one cone of each item, whose head has no unknowns."""
    by_item = np.arange(body.shape[0]).reshape(-1, items).T
    head = sparse.csr_matrix((1, body.shape[1]))
    return sparse.csc_matrix(sparse.vstack([part for order in by_item for part in (head, body[order])]))


def _constants(rows: Rows) -> Array:
    """Return the constants of rows in the order of their block."""
    if rows.over_time is None:
        return rows.constant.ravel()
    heads = np.full((1, len(rows.items)), rows.over_time)
    return np.concatenate([heads, rows.constant]).T.ravel()


def _block(rows: Rows, knots: int) -> Block:
    count = len(rows.constant)
    if rows.over_time is not None:
        return Block(rows.limit, rows.kind, 1 + count, rows.items, knots - 1, 1)
    if rows.inside is not None:
        return Block(rows.limit, rows.kind, rows.dim, rows.items, 0, count, between=True, friction=rows.friction)
    return Block(rows.limit, rows.kind, rows.dim, rows.items, knots - count, count, friction=rows.friction)


def _rows(formulation: Formulation, limits: Sequence[Limit], goal: Goal) -> list[Rows]:
    """Return the rows of limits and goal, first those at the knots, then those between them when that is asked for.

    What is asked for in other cases than the one stated is not asked of references, which are the same in all.
    """
    parts: tuple[Limit | Goal, ...] = (*limits, goal)
    if formulation.allowed is None and formulation.intersample is None:
        return _in_order([rows for part in parts for rows in part.rows(formulation)])
    stated, rows = _Instants.of(formulation), list[Rows]()
    cases, offs = ([], []) if formulation.allowed is None else formulation.allowed.formulations(formulation)
    in_cases, in_offs = ([_Instants.of(each) for each in parts] for parts in (cases, offs))
    for part in parts:
        alone = isinstance(part, Limit) and part.of_references_alone
        if alone or not in_cases:
            rows += stated.rows(part)
        else:
            rows += in_all_cases([each.rows(part) for each in in_cases], [each.rows(part) for each in in_offs])
    return _in_order(rows)


def _in_order(rows: list[Rows]) -> list[Rows]:
    return sorted(rows, key=lambda part: part.inside is not None)


@dataclass(frozen=True)
class _Instants:
    """A formulation at its knots, and between them where that is asked for."""

    formulation: Formulation
    reserve: Reserve | None

    @classmethod
    def of(cls, formulation: Formulation) -> _Instants:
        between = formulation.intersample
        return cls(formulation, None if between is None else Reserve.of(formulation, between))

    def rows(self, part: Limit | Goal) -> Sequence[Rows]:
        """Return the rows of a limit or goal; what couples knots is asked for at these alone."""
        if self.reserve is None or (isinstance(part, Limit) and part.couples_knots):
            return part.rows(self.formulation)
        return self.reserve.kept(part.rows, self.formulation)


def _quadratic(
    squares: Sequence[Squares], knots: int, n_v: int, extra: int, basis: sparse.csc_matrix | None
) -> tuple[sparse.csc_matrix, Array]:
    """Return P (n, n) and q (n,) of half the sum of squares, constants left out."""
    n = (knots * n_v if basis is None else basis.shape[1]) + extra
    P, q = None, np.zeros(n)
    for part in squares:
        if basis is None and not extra and not part.earlier and len(part.constant) == knots:
            own, linear = _of_each_knot(part, knots, n_v)
        else:
            band = Band(part.matrix, part.earlier, np.zeros(part.matrix.shape[-2]), len(part.constant))
            B = in_basis(stacked([band], knots, n_v, extra), basis, extra)
            own, linear = sparse.csc_matrix(B.T @ B), B.T @ part.constant.ravel()
        P, q = own if P is None else P + own, q + linear
    return copy(_none_quadratic(n)) if P is None else P, q  # a solver of one's own may set entries of it


@lru_cache(maxsize=64)
def _none_quadratic(n: int) -> sparse.csc_matrix:
    """Return P (n, n) without entries, to be copied: to make one takes many times as long."""
    none = sparse.csc_matrix((n, n))
    none.indptr.setflags(write=False)  # shared by all copies
    return none


def _of_each_knot(part: Squares, knots: int, n_v: int) -> tuple[sparse.csc_matrix, Array]:
    """Return P and q of squares none of which looks at two knots: one block after the other."""
    matrix = without_rounding(part.matrix)
    block = Band(gram(matrix), (), np.zeros(n_v), knots, exact=True)
    return stacked([block], knots, n_v, 0), times(matrix.mT, part.constant).ravel()
