"""The fastest timing of a path in the linear model: one convex program, and where rates are limited a local answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.at_a_value import solved
from synergrip.conic.certificate import DUAL_TOLERANCE
from synergrip.conic.decide import Decision
from synergrip.conic.limits.synergy_rate import SynergyRate
from synergrip.conic.program import Program
from synergrip.linalg import Array, frozen
from synergrip.margin.timing.program import FASTEST, TimingProgram, duration
from synergrip.margin.timing.question import TimingQuestion
from synergrip.margin.timing.rates import kept_by, relaxed, tangent, with_rates
from synergrip.values import Value

NAME = "fastest timing"
HELD = 1e-6
"""Violation of a row between grid points, in its unit, that is not worth a reserve."""
ROUNDS, NEAR = 4, 3.0
"""How often it is asked anew in units that suit what came of it; b is then as many times its unit at most, or least."""
MORE = 1.25
"""How much larger than the violation between grid points a reserve is."""
RESERVES = 5
"""How often a reserve is made larger."""
SLOWER = (1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 1e-3)
"""Factors of b from which on a timing within all rates is looked for."""
STEPS, SETTLED = 12, 1e-6
"""How often a local answer is bettered at most, and the share of the time that is not worth another step."""

Usual = tuple[Array | float, Array | float]
"""Acceleration along the path and square of the speed, one for all or (2 n,) at both sides of every part."""


@dataclass(frozen=True, eq=False, repr=False)
class Timing(Value):
    """A timing of a path in the linear model, and below which time there is none."""

    question: TimingQuestion
    """In whose units the unknowns are."""
    v: Array  # (n + 1, n_v) unknowns of the plan at the grid points
    b: Array  # (n + 1,) squares of the speed there [m^2/s^2]
    seconds: float
    least: float | None
    """No timing on this grid is shorter [s]; None where that did not verify."""
    local: bool
    """Whether it is the best in its neighbourhood only."""
    reserve: float = 0.0
    """The largest share of a limit, in the unit of its rows, that a part leaves for what is between its ends."""


def fastest(pose: Callable[[Usual], TimingQuestion], usual: Usual, rates: Sequence[SynergyRate]) -> Timing | str:
    """Return the fastest timing, or why there is none.

    Args:
        pose: returns the question of a path, a grasp and limits, in units that suit a usual timing.
        usual: acceleration and square of the speed as they are about [m/s^2, m^2/s^2]; what comes of it is asked again
            in the units that it takes itself.
        rates: limits on the rates of references.
    """
    for _ in range(ROUNDS):
        timing = TimingProgram(pose(usual), float(np.max(usual[1])))
        decision = solved(NAME, with_rates(timing.program, relaxed(timing, rates)))
        if decision.infeasible:
            return "no timing keeps all limits, which is proven of the linear model of the start posture"
        if not decision.acceptable:
            return "the program of the fastest timing did not verify"
        _, b = timing.plan(decision.solution.x)
        usual = np.repeat(np.diff(b) / (2 * timing.question.parts), 2), np.column_stack([b[:-1], b[1:]]).ravel()
        if 1 / NEAR < b.max() / timing.unit < NEAR:
            return _whole(timing, rates, decision)
    return f"no end of it was found up to {FASTEST ** ((ROUNDS - 1) / 2):g} times as fast: give a limit on the forces"


def _whole(timing: TimingProgram, rates: Sequence[SynergyRate], decision: Decision) -> Timing | str:
    """Return the fastest timing, with the reserve that limits need between the grid points."""
    least = _least(timing, decision)
    reserve = np.zeros(len(timing.question.parts))
    for _ in range(RESERVES):
        found = _kept(timing, rates, reserve, decision)
        if isinstance(found, str):
            return found
        missing = timing.question.missing(found.v, found.b)
        if missing.max() <= HELD:
            return replace(found, least=least, reserve=float(reserve.max()))
        reserve = reserve + MORE * missing
    return "limits do not hold between the points at which the path is looked at"


def _least(timing: TimingProgram, decision: Decision) -> float | None:
    """Return the time below which the multipliers prove that there is no timing [s]; None where they are none."""
    certificate = decision.certificate
    if not (decision.acceptable and certificate.dual_residual <= DUAL_TOLERANCE):
        return None
    value = timing.program.objective(decision.solution.x)
    return timing.seconds * (value - certificate.gap * max(1.0, abs(value)))


def _kept(timing: TimingProgram, rates: Sequence[SynergyRate], reserve: Array, first: Decision) -> Timing | str:
    """Return the fastest timing with a reserve, or why there is none."""
    decision = first
    if np.any(reserve):
        decision = solved(NAME, with_rates(timing.with_reserve(reserve), relaxed(timing, rates)))
        if not decision.acceptable:
            return "no timing was found with the reserve that limits need between the points of the path"
    v, b = timing.plan(decision.solution.x)
    seconds = duration(timing.question, b)
    if kept_by(timing, rates, v, b):
        return Timing(timing.question, frozen(v), frozen(b), seconds, None, local=False)
    return _local(timing, rates, timing.with_reserve(reserve), b)


def _local(timing: TimingProgram, rates: Sequence[SynergyRate], program: Program, b: Array) -> Timing | str:
    """Return a timing within all rates that small changes do not better; from slower ones on until there is one.

    Each step takes the tangents at the one before.
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
    decision = solved(NAME, with_rates(program, tangent(timing, rates, b)))
    if not decision.acceptable:
        return None
    v, found = timing.plan(decision.solution.x)
    return Timing(timing.question, frozen(v), frozen(found), duration(timing.question, found), None, local=True)
