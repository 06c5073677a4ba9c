"""How far one number may go toward less room before there is no plan: by one program, or by bisection."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import between, decided_at, narrowed, no_plan, posed_at, solved, with_room
from synergrip.changes.least_change import turning_column, with_turns
from synergrip.conic.certificate import judge_infeasible
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.conic.relaxed import relaxed
from synergrip.conic.solution import Settings
from synergrip.conic.solvers import clarabel_
from synergrip.linalg import Array
from synergrip.values import Value

FAR = 1e3
"""Times itself as far as which a number is followed that grows."""
BEYOND = (1e-3, 1e-2, 1e-1)
"""Shares of a value by which it is left behind, one after the other, until it is proven that there is no plan."""
ROUGHLY = Settings(tolerance=1e-8)
"""How a program is solved that says where it is worth while to look."""
GUESSES, ABOUT = 12, 2e-5
"""How often it is guessed where plans end, and how near each other guesses are at least, relatively."""
NEARER = {"up": (0.5, 0.8, 0.9, 0.96, 0.99, 0.999), "down": (0.25, 1.0, 3.0, 10.0, 100.0, FAR)}
"""Relative turns that are tried until there is no plan, before the last one with a plan is looked for."""


@dataclass(frozen=True, eq=False, repr=False)
class Extreme(Value):
    """How far a number may go, in the linear model of the start posture."""

    dial: Dial[Asked]
    value: float | None
    """The last value with a plan; None where none was found, as far as the number is followed, without one."""
    past: float | None
    """The nearest value of which it is certified that there is none: 0.1 % farther; where a reserve asks for more than
    is needed 0.1 % farther than without it, or 1 or 10 %. None where nothing is proven."""


def extreme(dial: Dial[Asked], posed: Posed, program: Program) -> Extreme:
    """Return how far a number may go toward less room.

    Args:
        dial: the number, in whose values sets of plans are nested.
        posed: what is asked, as a program of the start posture.
        program: that program, which has a plan.
    """
    value, rays = _by_one_program(dial, posed, program) if dial.smooth else (None, ())
    if value is None:
        value = _by_bisection(dial, posed)
    if value is None:
        return Extreme(dial, None, None)
    value = with_room(dial, value)
    return Extreme(dial, value, _past(dial, value, posed, rays))


def _by_one_program(dial: Dial[Asked], posed: Posed, program: Program) -> tuple[float | None, tuple[Array, ...]]:
    """Return the extreme value by a program with one more unknown, and the multipliers there; None without any.

    None where nothing verifies.
    """
    column = turning_column(dial, posed, program)
    if column is None:
        return None, ()
    most = 1.0 if dial.eased == "up" else FAR  # to 0, or to many times the number
    decision = solved("farthest turn", with_turns(program, [-column], [most], most=True))
    if not decision.optimal:
        return None, ()
    turn = float(np.clip(decision.solution.x[-1], 0.0, most))
    if turn >= most * (1 - 1e-6):
        return None, ()
    return dial.ahead(-turn), (decision.solution.z[: len(program.b)],)


def _by_bisection(dial: Dial[Asked], posed: Posed) -> float | None:
    """Return the extreme value between the number, which has a plan, and one that has none."""

    def has_plan(value: float) -> bool:
        decision = decided_at(dial, value, posed)
        return decision is not None and decision.acceptable

    good = dial.value
    for turn in NEARER[dial.eased]:
        value = dial.ahead(-turn)
        if not has_plan(value):
            good, bad = _guessed(good, value, partial(_missing, dial, posed), has_plan)
            return narrowed(good, bad, has_plan)[0]
        good = value
    return None


def _missing(dial: Dial[Asked], posed: Posed, value: float) -> float | None:
    """Return about by how much all cones must be wider at another value, below 0 where there is room; None unknown.

    It is not verified, and says only where it is worth while to look.
    """
    other = posed_at(dial, value, posed)
    if other is None:
        return None
    found = clarabel_.solve(relaxed(other.program()), ROUGHLY)
    return float(found.x[-1]) if np.isfinite(found.x[-1]) else None


def _guessed(
    good: float, bad: float, missing: Callable[[float], float | None], has_plan: Callable[[float], bool]
) -> tuple[float, float]:
    """Return values nearer each other, one with a plan and one without, around a zero of what is missing.

    What is missing bends one way in many numbers: a line through two values on one side of the zero then ends short of
    it, one through a value with and one without beyond it. So guesses close in from both sides.
    """
    known: dict[float, float] = {}
    goods, bads, value = [good], [bad], bad
    for count in range(GUESSES):
        short = missing(value)
        if short is None:
            break
        known[value] = short
        (goods if short <= 0 else bads).append(value)
        good, bad = goods[-1], bads[-1]
        if abs(good - bad) <= 2 * ABOUT * abs(good):
            break
        pairs = [(bad, good)] if count % 2 and good in known else [bads[-2:], goods[-2:]]
        inside = (zero for zero in (_zero(known, pair) for pair in pairs) if min(good, bad) < zero < max(good, bad))
        value = next(inside, between(good, bad))
        past = np.sign(good - bad) * ABOUT * abs(good)  # past the zero, where a guess is next to one of them
        value = float(np.clip(value, *sorted((bad + past, good - past))))
    good = next((each for each in reversed(goods[1:]) if has_plan(each)), goods[0])
    bad = next((each for each in reversed(bads[1:]) if not has_plan(each)), bads[0])
    return good, bad


def _zero(known: Mapping[float, float], pair: Sequence[float]) -> float:
    """Return where the line through two known values is 0; nowhere (NaN) where there is no such place."""
    if len(pair) < 2 or not all(value in known for value in pair):
        return float("nan")
    (first, second), (much, less) = pair, (known[value] for value in pair)
    return second - less * (second - first) / (less - much) if less != much else float("nan")


def _past(dial: Dial[Asked], value: float, posed: Posed, rays: Sequence[Array]) -> float | None:
    """Return the nearest of some values farther on of which it is certified that there is no plan.

    Where a reserve asks for more than is needed, it is what is asked without one that ends there.
    """
    if not dial.nested:
        return None
    if posed.strict:
        return _proven_past(dial, value, posed, rays, BEYOND[:1])
    sharp = replace(dial, turned=lambda other: dial.turned(other).sharp)
    own = posed_at(sharp, dial.value, posed)
    if own is not None and dial.smooth:
        end, rays = _by_one_program(sharp, own, own.program())
        if end is not None:
            farthest = min(end, value) if dial.eased == "up" else max(end, value)
            if (past := _proven_past(sharp, farthest, own, rays, BEYOND[:1])) is not None:
                return past
    past = None if own is None else _proven_past(sharp, value, own, (), BEYOND)
    return _proven_past(dial, value, posed, (), BEYOND) if past is None else past


def _proven_past(
    dial: Dial[Asked], value: float, posed: Posed, rays: Sequence[Array], shares: Sequence[float]
) -> float | None:
    """Return the first value farther on by one of some shares of it of which it is certified that there is no plan.

    Where it is the same program that is asked there, the multipliers at the extreme are tried as proofs first.
    """
    for share in shares:
        farther = dial.easier(value, -share * abs(value))
        there = posed_at(dial, farther, posed, every=True)
        if _proven_by(rays, there, posed) or no_plan(there):
            return farther
    return None


def _proven_by(rays: Sequence[Array], there: Posed | None, posed: Posed) -> bool:
    """Return whether some multipliers certify that there is no plan, in the units in which they were found."""
    if there is None or not rays or not posed.strict:
        return False
    program = replace(there, formulation=there.formulation.in_units(posed.formulation.units)).program()
    return any(len(ray) == len(program.b) and judge_infeasible(program, ray).verified for ray in rays)
