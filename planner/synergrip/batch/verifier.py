"""Answers of many programs re-verified from their data, by the definitions of `conic/certificate.py`.

NumPy only: nothing here knows how an answer was found. Optimal: the slack ``b - A x`` lies in its cones and x in its
box, the multipliers, moved into the dual cones, are stationary, and primal and dual objective agree. Infeasible: for y
in the dual cones, ``b'y + |A'y|' box < 0`` leaves no x in the box.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.cone_problems import ConeProblems
from synergrip.conic.affine import times
from synergrip.conic.certificate import DUAL_TOLERANCE, FAR, GAP_TOLERANCE, PRIMAL_TOLERANCE, ROUNDING
from synergrip.conic.cones import project_second_order
from synergrip.linalg import Array
from synergrip.values import Value

SMALL = 1e-2
"""Value of a sum of squares below which the gap has to be small beside the value, not beside 1."""

NOTHING = 1e-5
"""Value of a sum of squares that is nothing: with a gap that is small beside it, forces are known to 1e-6 of a unit."""


@dataclass(frozen=True, eq=False, repr=False)
class Verified(Value):
    """What was found of N claims: the figures of `Certificate`, and whether they bear the claim out."""

    verified: NDArray[np.bool_]
    primal_residual: Array
    dual_residual: Array
    gap: Array


@np.errstate(all="ignore")
def judge_optimal(problems: ConeProblems, x: Array, z: Array, bounds: Array, constant: Array | None = None) -> Verified:
    """Judge the claims that x (N, n) are optimal, with multipliers z (N, m).

    Args:
        problems: the programs.
        x: unknowns.
        z: multipliers of ``b - A x``.
        bounds: (n,), or (N, n), of |x|.
        constant: (N,) of objectives that are sums of squares; None for others.
    """
    slack = problems.b - times(problems.A, x)
    primal = np.maximum(outside(problems, slack), (np.abs(x) - bounds).max(axis=1, initial=-np.inf))
    moved = projected(problems, z)
    of_P = times(problems.P, x)
    left = of_P + problems.q + times(problems.A.mT, moved)
    size = np.maximum(1.0, np.maximum(np.abs(problems.q).max(axis=1), np.abs(of_P).max(axis=1)))
    dual = np.abs(left).max(axis=1) / size
    half = (x * of_P).sum(axis=1) / 2
    value, bound = half + (x * problems.q).sum(axis=1), -half - (problems.b * moved).sum(axis=1)
    missing = (np.abs(left) * np.where(np.abs(x) > FAR, np.abs(x), 0.0)).sum(axis=1)
    beside = np.maximum(1.0, np.maximum(np.abs(value), np.abs(bound)))
    if constant is not None:
        whole = value + constant
        beside = np.where(
            whole < SMALL,
            np.maximum(whole, NOTHING),
            np.maximum(beside, np.maximum(np.abs(whole), np.abs(bound + constant))),
        )
    gap = (np.abs(value - bound) + missing) / beside
    verified = (primal <= PRIMAL_TOLERANCE) & (dual <= DUAL_TOLERANCE) & (gap <= GAP_TOLERANCE)
    return Verified(verified, np.maximum(primal, 0.0), dual, gap)


@np.errstate(all="ignore")
def judge_infeasible(problems: ConeProblems, y: Array, bounds: Array) -> Verified:
    """Judge the claims that no x in the box |x| <= bounds (N, n) satisfies the programs, with the rays y (N, m)."""
    inside = projected(problems, y)
    drop = -(problems.b * inside).sum(axis=1)
    ray = inside / drop[:, None]
    moved = np.abs(ray - y / drop[:, None]).max(axis=1)
    leak = np.abs(times(problems.A.mT, ray))
    allowance = ROUNDING * (np.abs(problems.b) * np.abs(ray)).sum(axis=1)
    sign = -1.0 + (leak * bounds).sum(axis=1) + allowance
    verified = np.isfinite(y).all(axis=1) & (drop > 0) & (sign < 0)
    return Verified(verified, leak.max(axis=1), moved, sign)


def outside(problems: ConeProblems, values: Array) -> Array:
    """Return (N,) how far values (N, m) are outside their cones at most; below 0 inside."""
    worst = np.full(len(values), -np.inf)
    for group in problems.groups:
        part = values[:, group.rows].reshape(len(values), group.cones, group.size)
        beyond = -part[..., 0] if group.size == 1 else np.linalg.norm(part[..., 1:], axis=-1) - part[..., 0]
        worst = np.maximum(worst, beyond.max(axis=1))  # what is no number stays
    return np.where(np.isnan(worst), np.inf, worst)


def projected(problems: ConeProblems, y: Array) -> Array:
    """Return the points of the dual cones, which are the cones themselves, nearest to y (N, m)."""
    result = np.maximum(y, 0.0)
    for group in problems.groups:
        if group.size == 1:
            continue
        part = y[:, group.rows].reshape(len(y), group.cones, group.size)
        result[:, group.rows] = project_second_order(part).reshape(len(y), -1)
    return result
