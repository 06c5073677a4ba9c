"""A primal-dual interior-point method whose steps are solved knot after knot: for long trajectories.

With the Nesterov-Todd scaling W and lambda = W z = W^-1 s a step solves

    P dx + A'dz = -r_x,   A dx + ds = -r_s,   lambda o (W dz + W^-1 ds) = r_c

by a banded Cholesky factor of ``P + A'W^-2 A``, whose cost grows with the knots and no faster, with one refinement of
each solution; first with ``r_c = -lambda o lambda`` to predict, then with what that step leaves of second order and a
centring share to correct (Mehrotra). docs/performance.md has the derivation.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy import sparse

from synergrip.conic.banded.columns import Columns
from synergrip.conic.banded.cones import Cones, Scaling, cone_size
from synergrip.conic.banded.matrix import Factor, Matrix, NoFactorError
from synergrip.conic.banded.sheets import Sheet
from synergrip.conic.program import Program
from synergrip.conic.rows import Kind
from synergrip.conic.solution import Claim, Settings, Solution
from synergrip.linalg import Array, frozen

NAME = "synergrip interior point"
KNOTS = 200
"""From which on it is faster than Clarabel."""
LARGEST_CONE, WIDEST, MOST_BORDER = 12, 200, 40
"""Rows of a cone, unknowns side by side that one touches, and unknowns that all knots share: at most."""
MOST = 60
"""Iterations; nearly all programs take 10 to 25."""
GOOD, MODEST = 1e3, 1e5
"""Excess over the tolerance with which an answer is good, and with which it still claims to be an optimum."""
LATE = 1e-4
"""s'z of a cone from which on W is so uneven that solutions are refined."""
STUCK = 1e-5
"""A step shorter than this leads nowhere any more."""
BETTER = 0.98
"""Share of what the best state so far leaves; one that leaves less is better."""
NO_BETTER, PATIENCE = 4, 12
"""Iterations none of which is better than one that is good, or that is modest, after which none is waited for."""
LEAST_VALUE, LEAST_SCALAR = 1e-10, 1e-4
"""Value of a sum of squares, and of a scalar, below which a gap that is small beside 1 need not be small beside it."""
ROUNDING = 1e-17
"""Share of the terms of an objective that rounding always leaves of it, for sums of many terms."""


def suits(program: Program) -> bool:
    """Return whether a program is a long trajectory whose cones each look at few neighbouring knots."""
    return program.knots >= KNOTS and solvable(program)


def solvable(program: Program) -> bool:
    """Return whether a program has no equations, no large cones, and few unknowns that all knots share."""
    if not len(program.b) or any(b.kind is Kind.ZERO or cone_size(b) > LARGEST_CONE for b in program.blocks if b.rows):
        return False
    return len(program.q) - Columns.of(program).banded <= MOST_BORDER


def solve(program: Program, settings: Settings) -> Solution | None:
    """Solve a program that `suits`; None where its matrix is too wide for it."""
    begun = time.perf_counter()
    posed = _Posed.of(program)
    if len(posed.matrix.band) > WIDEST:
        return None
    with np.errstate(all="ignore"):  # of a program that comes to nothing: it is told by its status
        claim, status, best, iterations = _iterated(posed, settings)
    x, z = np.empty(len(best.x)), np.empty(len(best.z))
    x[posed.columns.order], z[posed.cones.order] = best.x, best.z
    seconds = time.perf_counter() - begun
    return Solution(claim, frozen(x), frozen(z), NAME, status, iterations, seconds)


@dataclass(frozen=True)
class _Posed:
    """The program in its own order of unknowns and rows."""

    P: sparse.csr_matrix
    q: Array
    b: Array
    program: Program
    constant: float
    columns: Columns
    cones: Cones
    matrix: Matrix
    sizes: sparse.csr_matrix
    """|P|."""

    @classmethod
    def of(cls, program: Program) -> _Posed:
        columns, cones = Columns.of(program), Cones.of(program)
        A, P = columns.ordered(program.A), columns.ordered(columns.ordered(program.P).T)
        matrix = Matrix.of(P, columns, [Sheet.of(A, columns, family) for family in cones.families])
        return cls(
            P, program.q[columns.order], program.b[cones.order],
            program, program.constant, columns, cones, matrix, abs(P),
        )  # fmt: skip

    @cached_property
    def bounds(self) -> Array:
        """(n,) the program's bounds on its unknowns."""
        return self.program.variable_bounds[self.columns.order]

    def times(self, x: Array) -> Array:
        """Return A x."""
        return self.matrix.times(x, self.cones)

    def back(self, y: Array) -> Array:
        """Return A'y."""
        return self.matrix.back(y, self.cones, len(self.q))


@dataclass(frozen=True)
class _State:
    x: Array
    s: Array
    z: Array
    W: Scaling
    """That of s and z, carried on by itself: made anew from these it would lose half of the digits."""


@dataclass(frozen=True)
class _Left:
    """What a state leaves to an optimum."""

    of_x: Array
    of_s: Array
    gap: float
    """s'z."""
    excess: float
    """Over what is asked for of cones, stationarity and objectives: 1 and less is an optimum, to the tolerance."""
    finer: float
    """The same with objectives beside their own value, where that is small."""
    proof: bool
    """Whether its z is a ray that no x in the box answers."""


def _iterated(posed: _Posed, settings: Settings) -> tuple[Claim, str, _State, int]:
    """Return the claim, the word for it, the best state and how many iterations it took."""
    try:
        state = _begun(posed)
    except NoFactorError:
        nothing = np.full(len(posed.q), np.nan)
        return Claim.NOTHING, "no factor", _State(nothing, posed.b, 0 * posed.b, Scaling.of_units(posed.cones)), 0
    best, least, kept, since = state, np.inf, np.inf, 0
    for iteration in range(MOST):
        left = _left(posed, state, settings.tolerance)
        if left.proof:
            return Claim.INFEASIBLE, "infeasible", state, iteration
        since = 0 if left.finer < BETTER * least else since + 1
        if left.finer < least:
            best, least, kept = state, left.finer, left.excess
        if least <= 1 or (since >= NO_BETTER and kept <= GOOD) or (since >= PATIENCE and kept <= MODEST):
            break
        try:
            moved = _stepped(posed, state, left, settings.step)
        except NoFactorError:
            break
        if moved is None:
            break
        state = moved
    if kept > MODEST:
        return Claim.NOTHING, "stuck", best, iteration
    return Claim.OPTIMAL, "solved" if kept <= 1 else "solved to fewer digits", best, iteration


def _begun(posed: _Posed) -> _State:
    """Return the least-squares point: the answer with W = 1, moved into the cones."""
    W = Scaling.of_units(posed.cones)
    x, z = _solved(posed, posed.matrix.factored(W), W, -posed.q, posed.b, refined=True)
    s, z = (_inside(posed.cones, part) for part in (-z, z))
    return _State(x, s, z, W.carried_on(s, z))


def _inside(cones: Cones, point: Array) -> Array:
    """Return a point (m,) moved along the unit where it is not well inside."""
    least = cones.least(point)
    size = max(1.0, float(np.abs(point).max(initial=0.0)))
    return point if least > 1e-8 * size else point + (1.0 - least) * cones.unit


def _left(posed: _Posed, state: _State, tolerance: float) -> _Left:
    x, z = state.x, state.z
    of_P, of_z = posed.P @ x, posed.back(z)
    of_x, of_s = of_P + posed.q + of_z, posed.times(x) + state.s - posed.b
    half, linear, bound = float(x @ of_P) / 2, float(posed.q @ x), float(posed.b @ z)
    value = half + linear
    rounding = ROUNDING * float(np.linalg.norm(x * (posed.sizes @ np.abs(x))))
    worth = max(abs(value + posed.constant), LEAST_VALUE if half > 0 else LEAST_SCALAR, rounding / tolerance)
    whole = max(1.0, abs(value))
    size = max(1.0, float(np.abs(posed.q).max(initial=0.0)), float(np.abs(of_P).max(initial=0.0)))
    missed = (
        float(np.abs(of_s).max(initial=0.0)), float(np.abs(of_x).max(initial=0.0)) / size,
        abs(value + half + bound) / whole,
    )  # fmt: skip
    finer = max(*missed[:2], missed[2] * max(whole / worth, 1.0))
    gap = float(state.W.point @ state.W.point)
    proof = bound < 0 and float(np.abs(of_z) @ posed.bounds) < -0.5 * bound
    return _Left(of_x, of_s, gap, max(missed) / tolerance, finer / tolerance, proof)


def _stepped(posed: _Posed, state: _State, left: _Left, boundary: float) -> _State | None:
    """Return the state one step on; None when it would hardly move."""
    W = state.W
    factor, of_s, point = posed.matrix.factored(W), W.unscaled(left.of_s), W.point

    def direction(wanted: Array, *, refined: bool) -> tuple[Array, Array, Array]:
        """Return dx, W^-1 ds and W dz with ``W dz + W^-1 ds = wanted``."""
        dx, dz = _solved(posed, factor, W, -left.of_x, -wanted - of_s, refined=refined)
        return dx, wanted - dz, dz

    _, ds, dz = direction(-point, refined=False)
    reach = min(1.0, W.longest_step(ds), W.longest_step(dz))
    centring = (1 - reach) ** 3 * left.gap / posed.cones.count
    wanted = W.divided(centring * posed.cones.unit - W.product(ds, dz)) - point
    dx, ds, dz = direction(wanted, refined=left.gap < LATE * posed.cones.count)
    step = min(1.0, boundary * min(W.longest_step(ds), W.longest_step(dz)))
    if not step > STUCK or not np.isfinite(dx).all():
        return None
    return replace(
        state, x=state.x + step * dx, s=state.s + W.scaled(step * ds), z=state.z + W.unscaled(step * dz),
        W=W.carried_on(point + step * ds, point + step * dz),
    )  # fmt: skip


def _solved(
    posed: _Posed, factor: Factor, W: Scaling, of_x: Array, of_s: Array, *, refined: bool
) -> tuple[Array, Array]:
    """Return dx and W dz with ``P dx + A'W^-1 (W dz) = of_x`` and ``W^-1 A dx - W dz = of_s``."""
    dx = factor.solve(of_x + posed.back(W.unscaled(of_s)))
    dz = W.unscaled(posed.times(dx)) - of_s
    if not refined:
        return dx, dz
    more = factor.solve(of_x - posed.P @ dx - posed.back(W.unscaled(dz)))
    return dx + more, dz + W.unscaled(posed.times(more))
