"""Every case that a plan is to hold for, at the true equilibria: the same references under other loads.

A pass along the motion asks for all cases by the maps of the path, under which other loads change the forces in a
straight line. The hand is not straight; so each case is executed, and where one misses a limit, what its load really
changes is asked for in further passes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from synergrip.conic.allowed import Allowed, Case
from synergrip.conic.departure import Departure, off_place
from synergrip.conic.formulation import Formulation
from synergrip.conic.intersample import Looks
from synergrip.equilibrium.execution import Execution
from synergrip.linalg import Array, frozen, interpolated
from synergrip.planning.between import Between
from synergrip.planning.figures import kept, missed_in, moved, rooms_of, stable
from synergrip.planning.in_case import InCase
from synergrip.planning.in_cases import ALL_CASES, limits_of_cases, titled, with_contacts_off
from synergrip.planning.kept_between import MoreAtKnots
from synergrip.planning.outcome import Check
from synergrip.planning.reach import off
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


def executed_cases(walk: Walk, walker: Walker, formulation: Formulation) -> ExecutedCases:
    """Return what a walk all of whose knots were reached uses in every case that its task allows for.

    Args:
        walk: references and their execution.
        walker: whose task it is.
        formulation: of the task at its knots, for names and units.
    """
    task, allowed = walker.task, walker.task.allowed
    if allowed is None:
        return ExecutedCases()
    looks, narrow = _looks(walk, walker), allowed.narrowed(formulation.whole)
    limits = limits_of_cases(task)
    offs = _offs(walk, walker, allowed, looks)
    names = [contact.name for contact in walker.start.grasp.contacts]
    found, missed, worst = list[InCase](), list[str](), dict[str, Check]()
    rooms: tuple[Array, ...] = ()
    for case in allowed.cases:
        title = titled(allowed, narrow, formulation, case.title)
        there = looks if case.extra is None else _under(looks, case)
        executed = _run(walk, walker, there)
        if not executed.whole:
            missed.append(f"{title}: {executed.why}")
            worst |= {title: Check(f"{ALL_CASES}: {missed[-1]}", np.inf, 0.0)}
            continue
        motion, states = moved(executed, there, walker, narrow)
        checks = [stable(executed, f"{ALL_CASES}: ")]
        for words, each in with_contacts_off(motion, walker.start.grasp.S, allowed, offs, names):
            usages = tuple(limit.usage(states, each) for limit in limits)
            rooms = rooms_of(walk, walker, limits, usages)
            found.append(InCase(", ".join(part for part in (title, words) if part), usages))
            missed += missed_in(usages, rooms, f"{found[-1].title}: ")
            checks += kept(usages, rooms, f"{ALL_CASES}: ")
        for check in checks:
            before = worst.get(check.name, check)
            worst[check.name] = check if check.error - check.tolerance > before.error - before.tolerance else before
    return ExecutedCases(tuple(found), tuple(worst.values()), tuple(missed), rooms)


def kept_in_cases(walk: Walk, walker: Walker, cases: ExecutedCases) -> tuple[Walk, Walker] | None:
    """Return a walk that keeps more in the cases in which limits are missed; None when no such one helps.

    First by what their loads really change, then by more margin at the knots.
    """
    allowed = walker.task.allowed
    if allowed is None or not cases.rooms:
        return None
    harder = _with_true_changes(walk, walker, allowed) if allowed.rounds < LOOKED_UP else None
    if harder is None:
        more = walker.more or MoreAtKnots.none(walker.task, walker.start.grasp.n_c)
        still = more.for_what_is_missing(_worst(cases), walker.task)
        harder = None if still is None else replace(walker, more=still)
    if harder is None:
        return None
    again = harder.on(replace(walk, gap=np.inf))
    arrives = again.true and float(off(again, harder).max()) <= harder.allowed
    return (again, harder) if arrives or again.interrupted else None


def _with_true_changes(walk: Walk, walker: Walker, allowed: Allowed) -> Walker | None:
    """Return who walks with what every load adds to the true forces at the knots.

    None where a case ends early, or where that is what was asked for already: what is missed is missed between them.
    """
    task, changed, new = walker.task, list[Case](), False
    knots = Looks(task.times, task.wrench, walker.wanted)
    for case in allowed.cases:
        if case.extra is None:
            changed.append(case)
            continue
        executed = _run(walk, walker, _under(knots, case))
        if not executed.whole:
            return None
        force = frozen(executed.states.forces - walk.executed.states.forces)
        new = new or case.force is None or float(np.abs(force - case.force).max()) > walk.room
        changed.append(replace(case, force=force))
    if not new:
        return None
    known = replace(allowed, cases=tuple(changed), rounds=allowed.rounds + 1)
    return replace(walker, task=replace(task, allowed=known))


def _worst(cases: ExecutedCases) -> Between:
    """Return of every limit what the case uses that is farthest beyond it."""
    limits = range(len(cases.rooms))
    worst = tuple(max((case.usages[i] for case in cases.cases), key=lambda usage: usage.violation) for i in limits)
    return Between(0, 0.0, 0.0, 0.0, worst, (), cases.rooms)


def _looks(walk: Walk, walker: Walker) -> Looks:
    """Return the instants at which limits count."""
    task = walker.task
    if len(task.times) < 2 or task.between == "report":
        return Looks(task.times, task.wrench, walker.wanted)
    return walker.looks(walk)


def _under(looks: Looks, case: Case) -> Looks:
    """Return the load of a case at some instants."""
    assert case.extra is not None
    return replace(looks, wrench=frozen(looks.wrench + case.extra.at(looks.times)))


def _run(walk: Walk, walker: Walker, looks: Looks) -> Execution:
    """Return the references of a walk executed under other loads."""
    references = frozen(interpolated(looks.times, walker.task.times, walk.references))
    near = walk.executed.interpolated(looks.times, looks.wrench)
    return walker.executor.run(looks.times, references, looks.wrench, near)


def _offs(walk: Walk, walker: Walker, allowed: Allowed, looks: Looks) -> list[Departure]:
    """Return what contacts that are off add, by the maps of the knots, at some instants."""
    assert walk.way is not None
    each, times = walk.way.each, walker.task.times
    found = off_place(lambda of: of(each), walker.start.grasp, allowed.gaps)
    return [Departure(*_at(looks.times, times, departure)) for departure in found]


def _at(times: Array, knots: Array, departure: Departure) -> Iterator[Array]:
    for name in ("force", "torque", "joint", "displacement"):
        yield frozen(interpolated(times, knots, getattr(departure, name)))
