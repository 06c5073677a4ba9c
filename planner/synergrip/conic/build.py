"""Limits and a goal, stacked into one sparse program."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy import sparse

from synergrip.conic.assembly import Band, stacked, without_rounding
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal, Objective, Squares
from synergrip.conic.limits.limit import Limit
from synergrip.conic.program import Block, Program
from synergrip.conic.reserve import Reserve
from synergrip.conic.rows import Rows
from synergrip.conic.variable_bounds import farthest, variable_bounds
from synergrip.linalg import Array, frozen


def build(formulation: Formulation, limits: Sequence[Limit], goal: Goal, worth: float = 1.0) -> Program:
    """Return the program that looks for the best plan by `goal` among those that keep all `limits`.

    Sums of squares are divided by `worth`.
    """
    rows = _rows(formulation, limits, goal)
    cost = goal.objective(formulation)
    extra = 0 if cost.epigraph is None else 1
    T, n_v = formulation.knots, formulation.n_v
    P, linear = _quadratic(cost.squares, T, n_v, extra)
    P.data, linear = P.data / worth, linear / worth
    A = _matrix(rows, T, n_v, extra)
    np.negative(A.data, out=A.data)  # the value of a row is b - A x
    q = linear if cost.epigraph is None else np.append(linear[:-1], cost.epigraph)
    b = np.concatenate([np.zeros(0), *(part.constant.ravel() for part in rows)])
    bounds = np.concatenate([np.tile(variable_bounds(formulation, limits), T), np.full(extra, farthest(formulation))])
    blocks = tuple(_block(part, T) for part in rows)
    program = Program(P, frozen(q), A, frozen(b), blocks, T, n_v, frozen(bounds), constant=_constant(cost) / worth)
    if formulation.time_basis is None:
        return program
    return _of_time_basis(program, formulation.time_basis, 1.0 if extra else formulation.divisor)


def _constant(cost: Objective) -> float:
    return sum(float((part.constant**2).sum()) / 2 for part in cost.squares)


def _of_time_basis(program: Program, time_basis: Array, divisor: float) -> Program:
    """Return the program whose unknowns are coefficients of time_basis in time (T, f), its squares over `divisor`."""
    extra = len(program.q) - program.knots * program.n_v
    N = sparse.block_diag(
        [sparse.kron(time_basis, sparse.eye_array(program.n_v)), sparse.eye_array(extra)], format="csc"
    )
    # the coefficients that make v are the pseudo-inverse of the time_basis times v
    sizes = np.abs(np.linalg.pinv(time_basis)) @ program.unknowns(program.variable_bounds)
    bounds = np.concatenate([sizes.ravel(), program.variable_bounds[len(program.variable_bounds) - extra :]])
    P, A = sparse.csc_matrix(N.T @ program.P @ N), sparse.csc_matrix(program.A @ N)
    P.data /= divisor
    q, constant = frozen(np.asarray(N.T @ program.q) / divisor), program.constant / divisor
    return replace(program, P=P, q=q, A=A, variable_bounds=frozen(bounds), time_basis=time_basis, constant=constant)


def _matrix(rows: Sequence[Rows], knots: int, n_v: int, extra: int) -> sparse.csc_matrix:
    """Return the matrix of rows, those at the knots before those between them."""
    at = [part for part in rows if part.inside is None]
    bands = [Band(part.matrix, part.earlier, part.epigraph, len(part.constant)) for part in at]
    A = stacked(bands, knots, n_v, extra)
    between = [_between(part, part.inside, extra) for part in rows if part.inside is not None]
    return sparse.csc_matrix(sparse.vstack([A, *between])) if between else A


def _between(rows: Rows, shares: sparse.csr_matrix, extra: int) -> sparse.csc_matrix:
    """Return the matrix of rows at instants (K,) that have `shares` (K, T) of the knots."""
    body = sparse.kron(shares, sparse.csr_matrix(without_rounding(rows.matrix)))
    scalar = sparse.csr_matrix(np.tile(rows.epigraph, len(rows.constant))[:, None])
    return sparse.csc_matrix(sparse.hstack([body, scalar]) if extra else body)


def _block(rows: Rows, knots: int) -> Block:
    count = len(rows.constant)
    if rows.inside is not None:
        return Block(rows.limit, rows.kind, rows.dim, rows.items, 0, count, between=True, friction=rows.friction)
    return Block(rows.limit, rows.kind, rows.dim, rows.items, knots - count, count, friction=rows.friction)


def _rows(formulation: Formulation, limits: Sequence[Limit], goal: Goal) -> list[Rows]:
    """Return the rows of limits and goal, first those at the knots, then those between them when that is asked for."""
    if formulation.intersample is None:
        return [part for limit in limits for part in limit.rows(formulation)] + list(goal.rows(formulation))
    reserve = Reserve.of(formulation, formulation.intersample)
    rows: list[Rows] = []
    for limit in limits:
        rows += limit.rows(formulation) if limit.couples_knots else reserve.kept(limit.rows, formulation)
    rows += reserve.kept(goal.rows, formulation)
    return sorted(rows, key=lambda part: part.inside is not None)


def _quadratic(squares: Sequence[Squares], knots: int, n_v: int, extra: int) -> tuple[sparse.csc_matrix, Array]:
    """Return P (n, n) and q (n,) of half the sum of squares, constants left out."""
    n = knots * n_v + extra
    P, q = sparse.csc_matrix((n, n)), np.zeros(n)
    for part in squares:
        band = Band(part.matrix, part.earlier, np.zeros(len(part.matrix)), len(part.constant))
        B = stacked([band], knots, n_v, extra)
        P, q = P + sparse.csc_matrix(B.T @ B), q + B.T @ part.constant.ravel()
    return P, q
