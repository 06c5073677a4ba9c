"""How far one number may go toward less room before there is no plan: by one program, or by bisection."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.least_change import CLOSE, decided_at, posed_at, solved, turning_column, with_turns
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.values import Value

FAR = 1e3
"""Times itself as far as which a number is followed that grows."""
BEYOND = (1e-3, 1e-2, 1e-1)
"""Shares of a value by which it is left behind, one after the other, until it is proven that there is no plan."""
ROOM = 2e-6
"""Relative room before the extreme: a plan on the very edge is a matter of rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class Extreme(Value):
    """How far a number may go, in the linear model of the start posture."""

    dial: Dial[Asked]
    value: float | None
    """The last value with a plan; None where none was found, as far as the number is followed, without one."""
    past: float | None
    """The nearest value of which it is certified that there is none: 0.1 % farther, or 1 or 10 % where between the
    knots a reserve asks for more than is needed. None where nothing is proven."""


def extreme(dial: Dial[Asked], posed: Posed, program: Program) -> Extreme:
    """Return how far a number may go toward less room.

    Args:
        dial: the number, in whose values sets of plans are nested.
        posed: what is asked, as a program of the start posture.
        program: that program, which has a plan.
    """
    value = _by_one_program(dial, posed, program) if dial.smooth else None
    if value is None:
        value = _by_bisection(dial, posed)
    if value is None:
        return Extreme(dial, None, None)
    value = short_of(dial, value)
    return Extreme(dial, value, _past(dial, value, posed))


def farthest(dial: Dial[Asked]) -> float:
    """Return the largest relative turn toward less room that is looked at: to 0, or to many times the number."""
    return 1.0 if dial.eased == "up" else FAR


def short_of(dial: Dial[Asked], value: float) -> float:
    """Return a value a little nearer, so that there is room for rounding."""
    back = ROOM * max(abs(value), abs(value - dial.value))
    return value + (back if dial.eased == "up" else -back)


def _by_one_program(dial: Dial[Asked], posed: Posed, program: Program) -> float | None:
    """Return the extreme value by a program with one more unknown; None where nothing verifies."""
    column = turning_column(dial, posed, program)
    if column is None:
        return None
    most = farthest(dial)
    decision = solved("farthest turn", with_turns(program, [-column], [most], most=True))
    if not decision.optimal:
        return None
    turn = float(np.clip(decision.solution.x[-1], 0.0, most))
    return dial.ahead(-turn) if turn < most * (1 - 1e-6) else None


def _by_bisection(dial: Dial[Asked], posed: Posed) -> float | None:
    """Return the extreme value between the number, which has a plan, and one that has none."""
    good, bad = dial.value, None
    for share in (0.5, 0.8, 0.9, 0.96, 0.99, 0.999) if dial.eased == "up" else (0.25, 1.0, 3.0, 10.0, 100.0, FAR):
        value = dial.ahead(-share)
        if _has_plan(dial, value, posed):
            good = value
        else:
            bad = value
            break
    if bad is None:
        return None
    while abs(good - bad) > CLOSE * max(abs(good), abs(bad)):
        middle = float(np.sqrt(good * bad)) if good * bad > 0 else (good + bad) / 2
        good, bad = (middle, bad) if _has_plan(dial, middle, posed) else (good, middle)
    return good


def _has_plan(dial: Dial[Asked], value: float, posed: Posed) -> bool:
    decision = decided_at(dial, value, posed)
    return decision is not None and decision.acceptable


def _past(dial: Dial[Asked], value: float, posed: Posed) -> float | None:
    """Return the nearest of some values farther on of which it is certified that there is no plan."""
    for share in () if not dial.nested else BEYOND[:1] if posed.strict else BEYOND:
        farther = value * (1 + share if dial.eased == "down" else 1 - share)
        other = posed_at(dial, farther, posed, every=True)
        for each in () if other is None else (other.at_knots, other):  # fewer rows prove as much, and sooner
            if solved("any plan", each.program()).infeasible:
                return farther
    return None
