"""Limits on the rates of references in a timing, as rows: by relaxation, and by tangents.

A reference changes in a part of length h by no more than its rate times ``2 h / (sqrt(b_k) + sqrt(b_k+1))``, which is
convex in b: the least timing is then no convex program. The unknown d in place of the fraction may be larger than it,
and asks for less than the rate: a bound for all timings. The tangent of the fraction is below it, and asks for more.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy import sparse

from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.linalg import Array, frozen
from synergrip.margin.timing.by_length import seconds_of
from synergrip.margin.timing.matrices import Sparse, below, beside, empty, ends, eye, scaled
from synergrip.margin.timing.program import TimingProgram

ROUNDING = 1e-6
"""Share of a rate that counts as none."""
Extra = tuple[Sparse, Array]
"""Rows ``right - matrix x >= 0``."""


def with_rates(program: Program, extra: Extra) -> Program:
    """Return the program with more rows."""
    matrix, right = extra
    if not len(right):
        return program
    block = Block(SynergyRate.key, Kind.NONNEGATIVE, 1, (Item("references"),), 0, len(right))
    A = sparse.csc_matrix(sparse.vstack([program.A, matrix]))
    return replace(program, A=A, b=frozen(np.append(program.b, right)), blocks=(*program.blocks, block))


def relaxed(timing: TimingProgram, rates: Sequence[SynergyRate]) -> Extra:
    """Return ``change <= rate 2 h d``."""
    n = timing.sizes[3]
    bound = beside(empty(n, sum(timing.sizes) - n), eye(n))
    return _less_than(_changes(timing, rates), bound, np.zeros(n))


def tangent(timing: TimingProgram, rates: Sequence[SynergyRate], b: Array) -> Extra:
    """Return ``change <= rate times the tangent of the time at b``, b (n + 1,) [m^2/s^2]."""
    n_v, m, _, n = timing.sizes
    square, speeds, sides = b / timing.unit, np.sqrt(b / timing.unit), ends(n)
    total = speeds[:-1] + speeds[1:]
    slopes = [np.where(each > 0, -1 / (2 * np.maximum(each, 1e-300) * total**2), 0.0)
              for each in (speeds[:-1], speeds[1:])]  # fmt: skip
    of_b = (scaled(slopes[0], sides[0]) + scaled(slopes[1], sides[1])) @ timing.spread
    known = 1 / total - slopes[0] * square[:-1] - slopes[1] * square[1:]
    return _less_than(_changes(timing, rates), beside(empty(n, n_v), sparse.csr_matrix(of_b), empty(n, m + n)), known)


def kept_by(timing: TimingProgram, rates: Sequence[SynergyRate], v: Array, b: Array) -> bool:
    """Return whether references keep their rates in every part of a timing."""
    if not rates:
        return True
    question = timing.question
    seconds = seconds_of(question.parts, b)[:, None]
    moved = np.abs(np.diff(v @ question.formulation.reference.matrix.T, axis=0)) / seconds
    return all(bool(np.all(moved <= rate.on(question.grasp).limit * (1 + ROUNDING))) for rate in rates)


def _changes(timing: TimingProgram, rates: Sequence[SynergyRate]) -> list[Sparse]:
    """Return (n, N) each: the change of a limited reference in each part, up or down, over its rate and ``2 h``."""
    question, found = timing.question, list[Sparse]()
    sides = ends(len(question.parts))
    steps = scaled(np.sqrt(timing.unit) / (2 * question.parts), sides[1] - sides[0])
    for rate in rates:
        limit = rate.on(question.grasp).limit
        for row in question.formulation.reference.matrix[np.isfinite(limit)] / limit[np.isfinite(limit), None]:
            each = sparse.csr_matrix(sparse.kron(steps, row[None, :]))
            whole = beside(each, empty(len(question.parts), sum(timing.sizes[1:])))
            found += [whole, sparse.csr_matrix(-whole)]
    return found


def _less_than(changes: Sequence[Sparse], bound: Sparse, known: Array) -> Extra:
    """Return ``changes x <= bound x + known``, the bound one for each part."""
    if not changes:
        return empty(0, int(bound.shape[1])), np.zeros(0)
    return below([sparse.csr_matrix(each - bound) for each in changes]), np.tile(known, len(changes))
