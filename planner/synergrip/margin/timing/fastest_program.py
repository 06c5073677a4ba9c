"""The fastest timing of a path in the linear model: one convex program, and where rates are limited a local answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from synergrip.changes.at_a_value import solved
from synergrip.conic.certificate import DUAL_TOLERANCE
from synergrip.conic.cones import distance_to_cones
from synergrip.conic.decide import Decision
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.program import Block, Program
from synergrip.conic.rows import Item, Kind
from synergrip.linalg import Array, frozen
from synergrip.margin.timing.program import FASTEST, TimingProgram, duration
from synergrip.margin.timing.question import TimingQuestion
from synergrip.values import Value

NAME = "fastest timing"
HELD = 1e-6
"""Violation of a row between grid points, in its unit, that is not worth a reserve."""
ROUNDS, NEAR = 4, 3.0
"""How often it is asked anew in units that suit what came of it; b is then as many times its unit at most, or least."""
MORE = 1.5
"""How much larger than the violation between grid points a reserve is."""
RESERVES = 3
"""How often a reserve is made larger."""
SLOWER = (1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 1e-3)
"""Factors of b from which on a timing within all rates is looked for."""
STEPS, SETTLED = 12, 1e-6
"""How often a local answer is bettered at most, and the share of the time that is not worth another step."""
SAME_TIME = 1e-6
"""Share of a time within which it is the least one of a convex program."""


Usual = tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False)
class Timing(Value):
    """A timing of a path in the linear model, and below which time there is none."""

    v: Array  # (n + 1, n_v) unknowns of the plan at the grid points
    b: Array  # (n + 1,) squares of the speed there [m^2/s^2]
    seconds: float
    least: float | None
    """No timing on this grid is shorter [s]; None where that did not verify."""
    local: bool
    """Whether it is the best in its neighbourhood only."""


def fastest(
    pose: Callable[[Usual], TimingQuestion], usual: Usual, rates: Sequence[SynergyRate]
) -> Timing | str:
    """Return the fastest timing, or why there is none.

    Args:
        pose: returns the question of a path, a grasp and limits, in units that suit a usual timing.
        usual: acceleration and square of the speed as they are about [m/s^2, m^2/s^2]; what comes of it is asked again
            in the units that it takes itself.
        rates: limits on the rates of references.
    """
    for _ in range(ROUNDS):
        timing = TimingProgram(pose(usual), usual[1])
        decision = solved(NAME, _with(timing.program, _relaxed_rates(timing, rates)))
        if decision.infeasible:
            return "no timing keeps all limits, which is proven of the linear model of the start posture"
        if not decision.acceptable:
            return "the program of the fastest timing did not verify"
        _, b = timing.plan(decision.solution.x)
        usual = float(np.abs(np.diff(b) / (2 * timing.question.parts)).max()), float(b.max())
        if 1 / NEAR < usual[1] / timing.unit < NEAR:
            return _whole(timing, rates, decision)
    return f"no end of it was found up to {FASTEST ** ((ROUNDS - 1) / 2):g} times as fast: give a limit on the forces"


def _whole(timing: TimingProgram, rates: Sequence[SynergyRate], decision: Decision) -> Timing | str:
    """Return the fastest timing, with the reserve that limits need between the grid points."""
    least = _least(timing, decision)
    reserve = 0.0
    for _ in range(RESERVES):
        found = _kept(timing, rates, reserve, decision)
        if isinstance(found, str):
            return found
        missing = _missing(timing.question, found)
        if missing <= HELD:
            return replace(found, least=least)
        reserve += MORE * missing
    return "limits do not hold between the points at which the path is looked at"


def _least(timing: TimingProgram, decision: Decision) -> float | None:
    """Return the time below which the multipliers prove that there is no timing [s]; None where they are none."""
    certificate = decision.certificate
    if not (decision.acceptable and certificate.dual_residual <= DUAL_TOLERANCE):
        return None
    value = timing.program.objective(decision.solution.x)
    return timing.seconds * (value - certificate.gap * max(1.0, abs(value)))


def _missing(question: TimingQuestion, found: Timing) -> float:
    """Return how far limits are from holding inside the parts."""
    inside = question.between(found.v, found.b)
    return distance_to_cones(inside, inside.b)


def _kept(timing: TimingProgram, rates: Sequence[SynergyRate], reserve: float, first: Decision) -> Timing | str:
    """Return the fastest timing with a reserve, or why there is none."""
    decision = first
    if reserve:
        decision = solved(NAME, _with(timing.with_reserve(reserve), _relaxed_rates(timing, rates)))
        if not decision.acceptable:
            return "no timing was found with the reserve that limits need between the points of the path"
    v, b = timing.plan(decision.solution.x)
    seconds = duration(timing.question, b)
    if _rates_kept(timing, rates, v, b):
        return Timing(frozen(v), frozen(b), seconds, None, local=False)
    return _local(timing, rates, timing.with_reserve(reserve), b)


def _local(timing: TimingProgram, rates: Sequence[SynergyRate], program: Program, b: Array) -> Timing | str:
    """Return a timing within all rates that small changes do not better; from slower ones on until there is one.

    The time of a part, ``2 h / (sqrt(b_k) + sqrt(b_k+1))``, is convex in b. Its tangent is below it: references that
    change by no more than their rate times the tangent keep the rate. Each step takes the tangents of the one before.
    """
    best: Timing | None = None
    for factor in SLOWER:
        best = _stepped(timing, rates, program, factor * b)
        if best is not None:
            break
    if best is None:
        return "no timing was found within the limits on rates"
    for _ in range(STEPS):
        better = _stepped(timing, rates, program, best.b)
        if better is None or better.seconds > best.seconds * (1 - SETTLED):
            return best if better is None or better.seconds > best.seconds else better
        best = better
    return best


def _stepped(timing: TimingProgram, rates: Sequence[SynergyRate], program: Program, b: Array) -> Timing | None:
    """Return the fastest timing whose references keep their rates by the tangents at b."""
    decision = solved(NAME, _with(program, _tangent_rates(timing, rates, b)))
    if not decision.acceptable:
        return None
    v, found = timing.plan(decision.solution.x)
    return Timing(frozen(v), frozen(found), duration(timing.question, found), None, local=True)


Extra = tuple[sparse.csr_matrix, Array]
"""Rows ``right - matrix x >= 0``."""


def _with(program: Program, extra: Extra) -> Program:
    """Return the program with more rows."""
    matrix, right = extra
    if not len(right):
        return program
    block = Block(SynergyRate.key, Kind.NONNEGATIVE, 1, (Item("references"),), 0, len(right))
    A = sparse.csc_matrix(sparse.vstack([program.A, matrix]))
    return replace(program, A=A, b=frozen(np.append(program.b, right)), blocks=(*program.blocks, block))


def _changes(timing: TimingProgram, rates: Sequence[SynergyRate]) -> sparse.csr_matrix:
    """Return (2 n m, N): the change of each limited reference in each part, up and down, over rate and usual time."""
    question = timing.question
    n, reference = len(question.parts), question.formulation.reference
    found = [sparse.csr_matrix((0, sum(timing.sizes)))]
    steps = sparse.diags_array([-np.ones(n), np.ones(n)], offsets=[0, 1], shape=(n, n + 1))
    usual = sparse.diags_array(np.sqrt(timing.unit) / (2 * question.parts))
    for rate in rates:
        limit = rate.on(question.grasp).limit
        keep = np.isfinite(limit)
        each = sparse.kron(usual @ steps, sparse.csr_matrix(reference.matrix[keep] / limit[keep, None]))
        rest = sparse.csr_matrix((each.shape[0], sum(timing.sizes) - each.shape[1]))
        found += [sparse.hstack([sign * each, rest], format="csr") for sign in (1.0, -1.0)]
    return sparse.csr_matrix(sparse.vstack(found))


def _relaxed_rates(timing: TimingProgram, rates: Sequence[SynergyRate]) -> Extra:
    """Return ``change <= rate 2 h d``: d may be larger than the part takes, so that it asks for less than the rate."""
    changes, n = _changes(timing, rates), len(timing.question.parts)
    return _less_than(changes, sparse.hstack([sparse.csr_matrix((n, sum(timing.sizes) - n)), sparse.eye_array(n)]), n)


def _less_than(changes: sparse.csr_matrix, bound: sparse.csr_matrix, n: int, right: Array | None = None) -> Extra:
    """Return ``changes x <= bound x + right``, the bound one for each part."""
    each = changes.shape[0] // n
    count = 1 if not each else each // 2
    order = np.tile(np.repeat(np.arange(n), count), 2)[: changes.shape[0]] if each else np.zeros(0, dtype=int)
    known = np.zeros(n) if right is None else right
    return sparse.csr_matrix(changes - sparse.csr_matrix(bound)[order]), known[order]


def _tangent_rates(timing: TimingProgram, rates: Sequence[SynergyRate], b: Array) -> Extra:
    """Return ``change <= rate times the tangent of the time at b``."""
    n_v, m, _, n = timing.sizes
    speeds = np.sqrt(b / timing.unit)
    total = speeds[:-1] + speeds[1:]
    with np.errstate(divide="ignore"):
        slopes = [np.where(each > 0, -1 / (2 * each * total**2), 0.0) for each in (speeds[:-1], speeds[1:])]
    ends = [sparse.eye_array(n, n + 1, k=k, format="csr") for k in (0, 1)]
    of_b = sum(sparse.diags_array(slope) @ end for slope, end in zip(slopes, ends, strict=True)) @ timing.spread
    known = 1 / total - sum(slope * (end @ (b / timing.unit)) for slope, end in zip(slopes, ends, strict=True))
    bound = sparse.hstack([sparse.csr_matrix((n, n_v)), of_b, sparse.csr_matrix((n, m + n))])
    return _less_than(_changes(timing, rates), sparse.csr_matrix(bound), n, known)


def _rates_kept(timing: TimingProgram, rates: Sequence[SynergyRate], v: Array, b: Array) -> bool:
    """Return whether references keep their rates in every part of a timing."""
    if not rates:
        return True
    speeds, question = np.sqrt(b), timing.question
    seconds = 2 * question.parts / (speeds[:-1] + speeds[1:])
    moved = np.abs(np.diff(v @ question.formulation.reference.matrix.T, axis=0)) / seconds[:, None]
    return all(bool(np.all(moved <= rate.on(question.grasp).limit * (1 + SAME_TIME))) for rate in rates)
