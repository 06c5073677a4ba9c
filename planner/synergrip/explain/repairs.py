"""Single changes after which a task has a plan: the least of each number, rounded toward room, planned again."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import between, outcome_at, with_room
from synergrip.changes.least_change import LeastChange, short_of
from synergrip.conic.limits.dial import Cause, Dial
from synergrip.documents.naming import made_by
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.pace import WHOLE, Effort
from synergrip.values import Value

T = TypeVar("T")
SHORT = 1e-3
"""Share of a value short of which there is proven to be no plan."""
ENOUGH = (0.02, 0.1)
"""How much farther than the least change of the start posture is tried in the short form, where the hand that moves
needs more; the first alone once some change has a plan, the last alone once one has none with either: each is one along
the motion."""
AROUND, WORTH, UNLIMITED = 2, 2, 10**9
"""For how many passes a plan counts beside its own, and with how many left it is still worth it to try another value;
as many as none ever takes."""
MORE = (0.0, 0.005, *ENOUGH, 0.2, 0.5, 1.0)
"""The same in the long form, which tells no more than the short one."""
NEAR = 0.02
"""Within how much of a value that is told one was tried in vain, in the long form."""
BEYOND = math.log(1e3)
"""How large a change is at most."""
TIE = 0.01
"""Relative difference below which two changes are as large as each other."""
ORDER: dict[str, int] = {"friction": 1, "load": 2, "amplitude": 2, "duration": 3, "stiffness": 3}
"""Which of two changes of the same size is named later; those of the limits that a user states come first."""


@made_by("answer.explain()")
@dataclass(frozen=True, eq=False, repr=False)
class Repair(Value):
    """A change of one number, and what planning says of it.

    Example:
        >>> repair = refused.repairs[0]  # of an `Infeasible`  # doctest: +SKIP
        >>> repair.set, repair.verified  # doctest: +SKIP
        ('limits.normal_force="16.593 N"', True)
    """

    cause: Cause
    key: str
    was: float
    to: float
    unit: str
    set: str
    """The argument of ``--set`` that does it."""
    verified: bool
    """Whether there is a verified plan with it, of the hand that moves where the task is about that one."""
    size: float
    """How large the change is: ``|ln(to / was)|``, or relative to the size of the task where one of them is 0."""
    proven: bool = False
    """Whether a certificate shows that 0.1 % short of it there is no plan, in the linear model of the start posture."""
    outcome: Outcome | None = None
    """What planning says with it."""
    least: float | None = None
    """What the linear model of the start posture takes at least; None where that was not looked for."""
    in_vain: float | None = None
    """The nearest smaller change that was tried and that no plan was found with; None where none was."""
    tried: bool = True
    """Whether it was planned with; the short form takes no longer than goes with a plan."""

    @classmethod
    def of(cls, dial: Dial[Asked], to: float, outcome: Outcome | None, *, proven: bool = False) -> Repair:
        """Return the change of a number to another value, with what planning says then."""
        verified, size = isinstance(outcome, Plan), dial.size(to)
        return cls(dial.cause, dial.key, dial.value, to, dial.unit, dial.set(to), verified, size, proven, outcome)


def ranked(found: Sequence[LeastChange]) -> list[LeastChange]:
    """Return the changes that help, the smallest first; of such as tie a user's limit before friction and load.

    Those that would leave next to nothing of a number, or make it more than anybody has, are no help.
    """
    helping = [each for each in found if each.value is not None and each.size < BEYOND]
    return by_size(helping, lambda each: each.size, lambda each: each.dial.cause)


def by_size(every: Sequence[T], size: Callable[[T], float], cause: Callable[[T], str]) -> list[T]:
    """Return changes in the order of their sizes; of such as tie a user's limit before friction and load."""
    left, result = sorted(every, key=size), list[T]()
    while left:
        tied = [each for each in left if size(each) <= size(left[0]) * (1 + TIE)]
        chosen = min(tied, key=lambda each: (ORDER.get(cause(each), 0), size(each)))
        left.remove(chosen)
        result.append(chosen)
    return result


def repaired(
    changes: Sequence[LeastChange], posed: Posed, *, most: int | None = None, prove: bool = True,
    effort: Effort = WHOLE, passes: int = UNLIMITED, heard: Callable[[Repair], None] = lambda repair: None,
) -> Iterator[Repair]:  # fmt: skip
    """Yield the repair of each change, planned again, as it is found.

    Args:
        changes: that help in the linear model of the start posture, the smallest first.
        posed: what was asked, as a program of the start posture.
        most: how many are planned again at most; the others are left out.
        prove: whether what is short of each is looked at, too, and more values are tried.
        effort: how much is tried along the motion.
        passes: how many are made along it for all of them at most; each plan counts as `AROUND` beside its own.
        heard: is told of each.
    """
    farther: tuple[float, ...] = MORE if prove else ENOUGH
    left = passes
    for change in changes[:most]:
        search, stopped = _Search(change, effort, left), False
        try:
            for known in _tries(search, posed, farther, nearer=prove):
                search, effort, left = known, known.effort, known.left
        except KeyboardInterrupt:
            if search.plan is None:
                raise
            stopped = True
        proven = prove and not stopped and short_of(change.dial, search.value, posed, SHORT)
        repair = search.repair(proven=proven)
        if farther == ENOUGH and repair.tried:
            farther = ENOUGH[:1] if repair.verified else ENOUGH[1:]
        heard(repair)
        yield repair
        if stopped:
            raise KeyboardInterrupt


@dataclass(frozen=True, eq=False, repr=False)
class _Search(Value):
    """Values of a number that were planned with."""

    change: LeastChange
    effort: Effort
    """How much is tried along the motion for the next one."""
    left: int
    """How many passes are left for it and for what is tried after it."""
    to: float | None = None
    """The nearest one with a plan, `plan`."""
    plan: Outcome | None = None
    in_vain: float | None = None
    """The nearest one without."""
    last: Outcome | None = None
    """What became of the one that was tried last."""

    @property
    def value(self) -> float:
        """What is told."""
        assert self.change.value is not None
        return beyond(self.change.dial, self.change.value, 0.0) if self.to is None else self.to

    def tried(self, value: float) -> _Search:
        """Return it with another value."""
        effort = replace(self.effort, passes=min(self.effort.passes, self.left - AROUND))
        outcome = outcome_at(self.change.dial, value, effort)
        passes = 0 if outcome is None or isinstance(outcome, Infeasible) else outcome.passes
        found = replace(self, effort=_from(outcome, self.effort), left=self.left - AROUND - passes, last=outcome)
        return replace(found, to=value, plan=outcome) if isinstance(outcome, Plan) else replace(found, in_vain=value)

    def repair(self, *, proven: bool) -> Repair:
        """Return what is told."""
        outcome = self.last if self.plan is None else self.plan
        found = Repair.of(self.change.dial, self.value, outcome, proven=proven)
        tried = self.to is not None or self.in_vain is not None
        vain = None if self.plan is None else self.in_vain
        return replace(found, least=self.change.value, in_vain=vain, tried=tried)


def _from(outcome: Outcome | None, effort: Effort) -> Effort:
    """Return a brief effort that begins where another one ended: another value of a number takes much the same motion.

    It begins at what was the end of the first one, in vain or not, until there is a plan.
    """
    executed = outcome.executed if isinstance(outcome, Plan | Unknown) else None
    known = effort.near is not None and not isinstance(outcome, Plan)
    return effort if executed is None or known or not effort.brief else replace(effort, near=executed)


def _tries(search: _Search, posed: Posed, farther: Sequence[float], *, nearer: bool) -> Iterator[_Search]:
    """Yield what is known of a change after each value that is tried: beyond the least one, and then nearer again."""
    dial, least = search.change.dial, search.change.value
    assert least is not None
    for more in farther if posed.analysis.grasp.held is not None else (0.0,):
        if search.left < AROUND + WORTH:
            break
        search = search.tried(beyond(dial, least, more))
        yield search
        if search.plan is not None:
            break
    while nearer and (value := _between(search)) is not None:
        search = search.tried(value)
        yield search


def _between(search: _Search) -> float | None:
    """Return a value between those with a plan and without; None where they are near each other, or one is missing."""
    good, bad, dial = search.to, search.in_vain, search.change.dial
    if good is None or bad is None or abs(good - bad) <= NEAR * max(abs(good), abs(bad)):
        return None
    value = dial.rounded(between(good, bad))
    return value if value not in (good, bad) else None


def beyond(dial: Dial[Asked], least: float, more: float) -> float:
    """Return a value a little beyond the least one, written in few digits, never past the end of the number.

    Args:
        dial: the number.
        least: its nearest value with a plan.
        more: share of the value by which to go farther.
    """
    value = dial.rounded(with_room(dial, least, more))
    return min(value, dial.end) if dial.eased == "up" else max(value, dial.end)
