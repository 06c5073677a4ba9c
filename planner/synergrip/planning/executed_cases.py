"""Every case that a plan is to hold for, at the true equilibria: the same references under other loads.

A pass along the motion asks for all cases by the maps of the path, under which other loads change the forces in a
straight line. The hand is not straight; so each case is executed, and where one misses a limit, what its load really
changes is asked for in further passes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.allowed import Case
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.conic.limits.limit import Usage
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen
from synergrip.planning.between import Between
from synergrip.planning.contacts_off import OffPlace, off_places, worst_of
from synergrip.planning.figures import kept, missed_in, stable
from synergrip.planning.in_case import InCase
from synergrip.planning.in_cases import ALL_CASES, titled
from synergrip.planning.kept_between import MoreAtKnots
from synergrip.planning.otherwise import Otherwise, walked_harder, worst_of_all
from synergrip.planning.outcome import Check
from synergrip.planning.verified import EQUILIBRIUM
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk
from synergrip.values import Value

LOOKED_UP = 3
"""How often what loads really change is looked up, at most."""
SHORT = 3
"""Cases that are named with what they miss."""


@dataclass(frozen=True, eq=False, repr=False)
class ExecutedCases(Value):
    """What references use of their limits in every case at the true states."""

    cases: tuple[InCase, ...] = ()
    checks: tuple[Check, ...] = ()
    """Of each limit the case that is farthest beyond it."""
    missed: tuple[str, ...] = ()
    """What is missed, in words."""
    rooms: tuple[Array, ...] = ()
    """(m,) of each limit, how far beyond it counts as kept."""

    @property
    def said(self) -> str:
        """What is missed; empty when nothing is."""
        if not self.missed:
            return ""
        more = f"; and {len(self.missed) - SHORT} more" if len(self.missed) > SHORT else ""
        told = "; ".join(self.missed[:SHORT])
        return f"at the true equilibrium limits are missed in cases that are allowed for: {told}{more}"

    def and_then(self, other: ExecutedCases) -> ExecutedCases:
        """Return these cases and others."""
        worst = dict[str, Check]()
        for check in (*self.checks, *other.checks):
            before = worst.get(check.name, check)
            worst[check.name] = check if check.error - check.tolerance > before.error - before.tolerance else before
        return ExecutedCases(
            (*self.cases, *other.cases), tuple(worst.values()), (*self.missed, *other.missed), other.rooms or self.rooms
        )


def executed_cases(walk: Walk, walker: Walker, formulation: Formulation) -> ExecutedCases:
    """Return what a walk all of whose knots were reached uses in every case that its task allows for.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
    """
    allowed = walker.task.allowed
    if allowed is None:
        return ExecutedCases()
    there = Otherwise.of(walk, walker, formulation, allowed)
    found, off = ExecutedCases(), list[OffPlace]()
    for case in allowed.cases:
        title = titled(allowed, there.narrow, formulation, case.title)
        looks = _under(there.looks, case)
        executed = there.run(looks, there.near(looks))
        if not executed.whole:
            found = found.and_then(_ended(title, executed))
            continue
        motion, states = there.moved(looks, executed)
        found = found.and_then(_judged(there, title, there.usages(states, motion), executed))
        off += off_places(there, title, looks, executed, motion, states)
    chosen = worst_of(off)
    for i, each in enumerate(off):
        found = found.and_then(_executed(there, each) if i in chosen else _judged(there, each.title, each.usages))
    return found


def _executed(there: Otherwise, case: OffPlace) -> ExecutedCases:
    """Return what is used of the limits with contacts off, executed."""
    executed = there.run(case.looks, case.in_place, case.setting(there.walker.executor.setting))
    if not executed.whole:
        return _ended(case.title, executed)
    motion, states = there.moved(case.looks, executed)
    return _judged(there, case.title, there.usages(states, motion), executed)


def _ended(title: str, executed: Execution) -> ExecutedCases:
    """Return that a case does not reach its end."""
    why = f"{title}: {executed.why}"
    return ExecutedCases(checks=(Check(f"{ALL_CASES}: {EQUILIBRIUM}", np.inf, 0.0),), missed=(why,))


def _judged(
    there: Otherwise, title: str, usages: tuple[Usage, ...], executed: Execution | None = None
) -> ExecutedCases:
    """Return what a case uses of the limits: executed, or by the maps of the knots."""
    rooms = there.rooms(usages)
    checks = kept(usages, rooms, f"{ALL_CASES}: ")
    if executed is not None:
        checks = (stable(executed, f"{ALL_CASES}: "), *checks)
    case = InCase(title, usages, by_maps=executed is None)
    return ExecutedCases((case,), checks, tuple(missed_in(usages, rooms, f"{title}: ")), rooms)


def kept_in_cases(
    walk: Walk, walker: Walker, formulation: Formulation, cases: ExecutedCases
) -> tuple[Walk, Walker] | None:
    """Return a walk that keeps more in the cases in which limits are missed; None when no such one helps.

    First by what their loads really change, then by more margin at the knots.
    """
    allowed = walker.task.allowed
    if allowed is None or not cases.rooms:
        return None
    there = Otherwise.of(walk, walker, formulation, allowed)
    harder = _with_true_changes(there) if allowed.rounds < LOOKED_UP else None
    if harder is None:
        more = walker.more or MoreAtKnots.none(walker.task, walker.start.grasp.n_c)
        worst = worst_of_all([case.usages for case in cases.cases])
        missing = Between(0, 0.0, 0.0, 0.0, worst, (), cases.rooms)
        still = more.for_what_is_missing(missing, walker.task, there.limits)
        harder = None if still is None else replace(walker, more=still)
    return None if harder is None else walked_harder(walk, harder)


def _with_true_changes(there: Otherwise) -> Walker | None:
    """Return who walks with what every load adds to the true forces at the knots.

    None where a case ends early, or where that is what was asked for already: what is missed is missed between them.
    """
    walk, walker, allowed = there.walk, there.walker, there.allowed
    task, changed, new = walker.task, list[Case](), False
    knots = Looks(task.times, task.wrench, walker.wanted)
    for case in allowed.cases:
        if case.extra is None:
            changed.append(case)
            continue
        executed = there.run(under := _under(knots, case), there.near(under))
        if not executed.whole:
            return None
        force = frozen(executed.states.forces - walk.executed.states.forces)
        new = new or case.force is None or float(np.abs(force - case.force).max()) > walk.room
        changed.append(replace(case, force=force))
    if not new:
        return None
    known = replace(allowed, cases=tuple(changed), rounds=allowed.rounds + 1)
    return replace(walker, task=replace(task, allowed=known))


def _under(looks: Looks, case: Case) -> Looks:
    """Return the load of a case at some instants."""
    if case.extra is None:
        return looks
    return replace(looks, wrench=frozen(looks.wrench + case.extra.at(looks.times)))
