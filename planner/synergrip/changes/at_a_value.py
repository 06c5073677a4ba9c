"""What becomes of a task with another value of one number: its program, its plan, and values between two others."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from logging import DEBUG, INFO

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.conic.decide import Decision, decide
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.conic.relaxed import proving
from synergrip.conic.solvers import clarabel_
from synergrip.conic.units import Units
from synergrip.errors import SynergripError
from synergrip.log import LONG
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.pace import WHOLE, Effort

CLOSE = 5e-5
"""Relative distance at which a bisection ends."""
ROOM = 2e-6
"""Relative room on the near side of an extreme value: a plan on the very edge is a matter of rounding."""


def solved(name: str, program: Program) -> Decision:
    """Return what comes of a program, verified."""
    return decide(name, program, proving(clarabel_.solve))


def posed_at(
    dial: Dial[Asked], value: float, posed: Posed, *, every: bool = False, units: Units | None = None
) -> Posed | None:
    """Return the program with another value; of `every` instant without a reserve where it is for a proof.

    None where a value is none that the number can have.
    """
    try:
        return dial.turned(value).posed(posed.analysis, units, every=every)
    except SynergripError:
        return None


def decided_at(dial: Dial[Asked], value: float, posed: Posed) -> Decision | None:
    """Return what comes of another value; None where it is none that the number can have."""
    other = posed_at(dial, value, posed)
    return None if other is None else solved("any plan", other.program())


def outcome_at(dial: Dial[Asked], value: float, effort: Effort = WHOLE) -> Outcome | None:
    """Return what planning says with another value; None where it is refused as bad input."""
    try:
        asked = dial.turned(value)
        LONG.log(INFO if asked.executes_samples else DEBUG, "planning with %s", dial.set(value))
        return asked.outcome(effort)
    except SynergripError:
        return None


def no_plan(posed: Posed | None) -> bool:
    """Return whether it is certified that there is no plan; with the rows of fewer instants first, which prove as much.

    Where some of the instants between the knots leave a plan, all of them hardly leave less: that is not looked into.
    """
    if posed is None:
        return False
    if posed.formulation.intersample is not None and solved("any plan", posed.at_knots.program()).infeasible:
        return True
    fewer = posed.at_fewer
    decision = None if fewer is None else solved("any plan", fewer.program())
    if decision is not None and (decision.infeasible or decision.acceptable):
        return decision.infeasible
    return solved("any plan", posed.program()).infeasible


def first_plan(dial: Dial[Asked], values: Iterable[float], effort: Effort = WHOLE) -> tuple[float, Plan] | None:
    """Return the first of some values with which planning has a plan, and the plan."""
    for value in values:
        outcome = outcome_at(dial, value, effort)
        if isinstance(outcome, Plan):
            return value, outcome
    return None


def with_room(dial: Dial[Asked], value: float, more: float = 0.0) -> float:
    """Return an extreme value with room for rounding, and with a share of itself more."""
    return dial.easier(value, max(more * abs(value), ROOM * max(abs(value), abs(value - dial.value))))


def narrowed(
    good: float, bad: float, has_plan: Callable[[float], bool], close: Callable[[float], float] = lambda bad: CLOSE
) -> tuple[float, float]:
    """Return values near each other, one with a plan and one without, between two such; how near, by the latter."""
    while abs(good - bad) > close(bad) * max(abs(good), abs(bad)):
        value = between(good, bad)
        good, bad = (value, bad) if has_plan(value) else (good, value)
    return good, bad


def between(one: float, other: float) -> float:
    """Return the value between two that is as many times the one as the other is times it; the mean across 0."""
    return float(np.sqrt(one * other)) if one * other > 0 else (one + other) / 2
