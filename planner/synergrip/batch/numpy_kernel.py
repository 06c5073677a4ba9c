"""A primal-dual interior-point method for many small cone programs of one shape: the readable path, in NumPy.

Every problem is one row of stacked arrays. With the Nesterov-Todd scaling W and lambda = W z = W^-1 s a step solves

    P dx + A'dz = -r_x,   A dx + ds = -r_s,   lambda o (W dz + W^-1 ds) = r_c

by a dense Cholesky factor of ``P + A'W^-2 A``: first with ``r_c = -lambda o lambda`` to predict, then with what that
step leaves of second order and a centring share to correct (Mehrotra). Problems that are through leave the arrays.
See docs/many.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.cone_problems import ConeProblems, ConeSolutions, Status, Tolerance
from synergrip.batch.scaling import Scaling, heads
from synergrip.linalg import Array

MOST = 50
"""Iterations; nearly all problems take 7 to 12."""
BOUNDARY = 0.98
"""Share of the way to the boundary of the cones that a step goes at most."""
STUCK = 1e-4
"""A step shorter than this leads nowhere any more."""
LEFT = 0.8
"""Share of the problems in the arrays that are not yet through, below which the others are taken out."""
NO_PIVOT = 1e-14
"""A pivot below this share of its diagonal is none: the direction is left as it is."""


@dataclass(frozen=True)
class _State:
    """Where N problems are."""

    problems: ConeProblems
    places: NDArray[np.intp]  # (N,) among all
    enough: Array  # (N,)
    x: Array
    s: Array
    z: Array
    W: Scaling
    """That of s and z, carried on by itself: made anew from these it would lose half of the digits."""

    def taken(self, which: NDArray[np.bool_]) -> _State:
        """Return some of them."""
        return _State(
            self.problems.taken(which), self.places[which], self.enough[which], self.x[which], self.s[which],
            self.z[which], self.W.taken(which),
        )  # fmt: skip


@dataclass(frozen=True)
class _Residuals:
    of_x: Array  # (N, n)
    of_s: Array  # (N, m)
    gap: Array  # (N,)
    done: NDArray[np.int8]  # (N,) of `Status`

    def taken(self, which: NDArray[np.bool_]) -> _Residuals:
        """Return those of some problems."""
        return _Residuals(self.of_x[which], self.of_s[which], self.gap[which], self.done[which])


def solve(problems: ConeProblems, tolerance: Tolerance, enough: Array) -> ConeSolutions:
    """Solve problems side by side.

    Args:
        problems: of one shape.
        tolerance: of residuals and gap.
        enough: (N,) a value of the objective with which a point that keeps all cones is taken; minus infinity for none.
    """
    N, n, m = len(problems), problems.q.shape[-1], problems.b.shape[1]
    found = ConeSolutions(
        np.zeros((N, n)), np.zeros((N, m)), np.zeros((N, m)),
        np.full(N, Status.NOTHING, dtype=np.int8), np.full(N, MOST, dtype=np.int32),
    )  # fmt: skip
    with np.errstate(all="ignore"):  # of problems that come to nothing: they are told by their status
        state, active = _start(problems, enough), np.ones(N, dtype=bool)
        for iteration in range(MOST):
            left = _residuals(state, tolerance)
            through = active & (left.done != Status.NOTHING)
            _keep(found, state, left, through, iteration)
            active &= ~through
            if not active.any():
                return found
            if active.mean() < LEFT:
                state, left = state.taken(active), left.taken(active)
                active = np.ones(len(state.places), dtype=bool)
            state, stuck = _stepped(state, left)
            gone = active & stuck
            _keep(found, state, left, gone, iteration)
            active &= ~gone
            if not active.any():
                return found
        _keep(found, state, _residuals(state, tolerance), active, MOST)
    return found


def _keep(found: ConeSolutions, state: _State, left: _Residuals, which: NDArray[np.bool_], iteration: int) -> None:
    places = state.places[which]
    found.x[places], found.s[places], found.z[places] = state.x[which], state.s[which], state.z[which]
    found.status[places], found.iterations[places] = left.done[which], iteration


def _start(problems: ConeProblems, enough: Array) -> _State:
    """Return the least-squares point: the answer with W = 1, moved into the cones."""
    W = Scaling.of_units(problems.groups, len(problems))
    q = np.broadcast_to(problems.q, (len(problems), problems.q.shape[-1]))
    x, z = _solved(_factor(problems.P + problems.A.mT @ problems.A), problems.A, -q, problems.b)
    unit = heads(problems.groups)
    s, z = (_inside(W, part, unit) for part in (-z, z))
    return _State(problems, np.arange(len(problems)), enough, x, s, z, W.carried_on(s, z))


def _inside(W: Scaling, point: Array, unit: Array) -> Array:
    """Return points (N, m) moved along the unit where they are not well inside."""
    least = W.least(point)
    size = np.maximum(1.0, np.sqrt((point**2).sum(axis=-1)))
    return np.asarray(point + np.where(least > 1e-8 * size, 0.0, 1.0 - least)[:, None] * unit)


def _residuals(state: _State, tolerance: Tolerance) -> _Residuals:
    """Return what is missing to an optimum, and where nothing is."""
    problems, x, s, z = state.problems, state.x, state.s, state.z
    of_P = (problems.P @ x[:, :, None])[:, :, 0]
    of_x = of_P + problems.q + (z[:, None, :] @ problems.A)[:, 0, :]
    of_s = (problems.A @ x[:, :, None])[:, :, 0] + s - problems.b
    gap = (state.W.point**2).sum(axis=-1)
    value = (x * of_P).sum(axis=-1) / 2 + (x * problems.q).sum(axis=-1)
    size = np.maximum(1.0, np.abs(of_P).max(axis=-1))
    kept = np.abs(of_s).max(axis=-1, initial=0.0) <= tolerance.residual
    stationary = np.abs(of_x).max(axis=-1) <= tolerance.residual * size
    inside = state.W.least(s - of_s) > 0  # of b - A x: long before s is that to the last digits
    solved = kept & stationary & (gap <= tolerance.gap * np.maximum(1.0, np.abs(value)))
    done = np.where(solved, Status.SOLVED, np.where(inside & (value < state.enough), Status.ENOUGH, Status.NOTHING))
    return _Residuals(of_x, of_s, gap, done.astype(np.int8))


def _stepped(state: _State, left: _Residuals) -> tuple[_State, NDArray[np.bool_]]:
    """Return the problems one step on, and which of them hardly moved."""
    W, problems = state.W, state.problems
    rows = W.unscaled_rows(problems.A)
    factor = _factor(problems.P + rows.mT @ rows)
    of_s = W.unscaled(left.of_s)
    point = W.point

    def direction(wanted: Array) -> tuple[Array, Array, Array]:
        """Return dx, W^-1 ds and W dz with ``W dz + W^-1 ds = wanted``."""
        dx, dz = _solved(factor, rows, -left.of_x, -wanted - of_s)
        return dx, wanted - dz, dz

    _, ds, dz = direction(-point)
    reach = np.minimum(1.0, np.minimum(W.longest_step(ds), W.longest_step(dz)))
    would_be = np.clip(1 - reach + reach**2 * (ds * dz).sum(axis=-1) / left.gap, 0.0, 1.0)  # as ds + dz = -lambda
    centring = would_be**1.5 * left.gap / len(problems.sizes)
    unit = heads(W.groups)
    wanted = W.divided(centring[:, None] * unit - W.product(ds, dz)) - point
    dx, ds, dz = direction(wanted)
    step = np.minimum(1.0, BOUNDARY * np.minimum(W.longest_step(ds), W.longest_step(dz)))[:, None]
    stuck = ~(step[:, 0] > STUCK) | ~np.isfinite(dx).all(axis=-1)
    step = np.where(stuck[:, None], 0.0, step)
    ds, dz, dx = (np.where(stuck[:, None], 0.0, each) for each in (ds, dz, dx))
    moved = replace(
        state, x=state.x + step * dx, s=state.s + W.scaled(step * ds), z=state.z + W.unscaled(step * dz),
        W=W.carried_on(point + step * ds, point + step * dz),
    )  # fmt: skip
    return moved, stuck


def _solved(factor: Array, rows: Array, of_x: Array, of_s: Array) -> tuple[Array, Array]:
    """Return dx and dz with ``P dx + A'dz = of_x``, ``A dx - dz = of_s`` by the factor of ``P + A'A``."""
    right = of_x + (of_s[:, None, :] @ rows)[:, 0, :]
    n = right.shape[1]
    y = np.empty(right.shape)
    for i in range(n):
        y[:, i] = (right[:, i] - (factor[:, i, :i] * y[:, :i]).sum(axis=-1)) / factor[:, i, i]
    for i in reversed(range(n)):
        y[:, i] = (y[:, i] - (factor[:, i + 1 :, i] * y[:, i + 1 :]).sum(axis=-1)) / factor[:, i, i]
    return y, (rows @ y[:, :, None])[:, :, 0] - of_s


def _factor(H: Array) -> Array:
    """Return the Cholesky factors L (N, n, n) of symmetric matrices; a direction without a pivot is left as it is."""
    L = np.zeros(H.shape)
    for j in range(H.shape[-1]):
        column = H[:, j:, j] - (L[:, j:, :j] @ L[:, j, :j, None])[:, :, 0]
        small = ~(column[:, 0] > NO_PIVOT * H[:, j, j])
        pivot = np.sqrt(np.where(small, 1e30 * np.maximum(H[:, j, j], 1.0), column[:, 0]))
        L[:, j:, j] = column / pivot[:, None]
        L[:, j, j] = pivot
    return L
