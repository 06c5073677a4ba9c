"""Single changes after which a task has a plan: the least of each number, rounded toward room, planned again."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import outcome_at, with_room
from synergrip.changes.least_change import LeastChange, short_of
from synergrip.conic.limits.dial import Cause, Dial
from synergrip.documents.naming import made_by
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.pace import WHOLE, Effort
from synergrip.values import Value

SHORT = 1e-3
"""Share of a value short of which there is proven to be no plan."""
MORE = (0.0, 0.002, 0.01, 0.05, 0.2, 0.5, 1.0)
"""How much farther than the least change of the start posture is tried, where the hand that moves needs more."""
ENOUGH = (0.02, 0.1)
"""The same in the short form; the first alone once some change has a plan: each is one along the motion."""
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

    @classmethod
    def of(cls, dial: Dial[Asked], to: float, outcome: Outcome | None, *, proven: bool = False) -> Repair:
        """Return the change of a number to another value, with what planning says then."""
        verified, size = isinstance(outcome, Plan), dial.size(to)
        return cls(dial.cause, dial.key, dial.value, to, dial.unit, dial.set(to), verified, size, proven, outcome)


def ranked(found: Sequence[LeastChange]) -> list[LeastChange]:
    """Return the changes that help, the smallest first; of such as tie a user's limit before friction and load.

    Those that would leave next to nothing of a number, or make it more than anybody has, are no help.
    """
    helping = sorted((each for each in found if each.value is not None and each.size < BEYOND), key=lambda e: e.size)
    result: list[LeastChange] = []
    while helping:
        smallest = helping[0].size
        tied = [each for each in helping if each.size <= smallest * (1 + TIE)]
        chosen = min(tied, key=lambda each: (ORDER.get(each.dial.cause, 0), each.size))
        helping.remove(chosen)
        result.append(chosen)
    return result


def repaired(
    changes: Sequence[LeastChange], posed: Posed, *, most: int | None = None, prove: bool = True,
    effort: Effort = WHOLE, heard: Callable[[Repair], None] = lambda repair: None,
) -> Iterator[Repair]:  # fmt: skip
    """Yield the repair of each change, planned again, as it is found.

    Args:
        changes: that help in the linear model of the start posture, the smallest first.
        posed: what was asked, as a program of the start posture.
        most: how many are planned again at most; the others are left out.
        prove: whether what is short of each is looked at, too, and more values are tried.
        effort: how much is tried along the motion.
        heard: is told of each.
    """
    farther: tuple[float, ...] = MORE if prove else ENOUGH
    for change in changes[:most]:
        repair = _planned(change, posed, farther, effort, prove=prove)
        farther = ENOUGH[:1] if repair.verified and not prove else farther
        heard(repair)
        yield repair


def _planned(change: LeastChange, posed: Posed, farther: Sequence[float], effort: Effort, *, prove: bool) -> Repair:
    """Return a change with the first value beyond the least one of which there is a verified plan."""
    dial, least = change.dial, change.value
    assert least is not None
    tried = None
    for more in farther if posed.analysis.grasp.held is not None else (0.0,):
        value = beyond(dial, least, more)
        tried = outcome_at(dial, value, effort)
        if isinstance(tried, Plan):
            break
    else:
        value = beyond(dial, least, 0.0)
    return Repair.of(dial, value, tried, proven=prove and short_of(dial, value, posed, SHORT))


def beyond(dial: Dial[Asked], least: float, more: float) -> float:
    """Return a value a little beyond the least one, written in few digits, never past the end of the number.

    Args:
        dial: the number.
        least: its nearest value with a plan.
        more: share of the value by which to go farther.
    """
    value = dial.rounded(with_room(dial, least, more))
    return min(value, dial.end) if dial.eased == "up" else max(value, dial.end)
