"""Pairs of changes that leave a plan where no single one does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from synergrip.changes.asked import Asked, Posed
from synergrip.changes.at_a_value import solved
from synergrip.changes.least_change import turning_column, with_turns
from synergrip.changes.turning import dials
from synergrip.conic.limits.dial import Dial
from synergrip.conic.program import Program
from synergrip.explain.repairs import Repair, beyond
from synergrip.linalg import Array
from synergrip.planning.outcome import Plan

MOST, TRIED = 3, 12
"""Pairs that are told, and that are planned at most."""
NOTHING = 1e-6
"""Relative turn that is none."""
GIVEN = ("friction", "load", "amplitude", "duration")
"""What is often not a user's to change: pairs of limits come first."""
FARTHER = (0.0, 0.05, 0.3)
"""How much farther than the least changes of the start posture is tried, on a hand."""


def pairs(numbers: Sequence[Dial[Asked]], posed: Posed, program: Program) -> Iterator[tuple[Repair, Repair]]:
    """Yield pairs of changes with a verified plan: those of limits first, of these the least sum of relative changes.

    Args:
        numbers: of which none helps alone; those of the load and of the motion among them.
        posed: what was asked, as a program of the start posture.
        program: that program.
    """
    columns = [(dial, turning_column(dial, posed, program)) for dial in numbers if dial.smooth]
    known = [(dial, column) for dial, column in columns if column is not None and np.any(column)]
    least = [_least(one, two, program) for one, two in combinations(known, 2)]
    told = tried = 0
    for _, values in sorted((each for each in least if each is not None), key=_last):
        if told == MOST or tried == TRIED:
            return
        pair, tried = _planned(values, posed), tried + 1
        if pair is not None:
            yield pair
            told += 1


def _last(found: tuple[float, tuple[_Turned, _Turned]]) -> tuple[int, float]:
    """Return by what pairs are sorted: how many are no limits, and how far they are turned."""
    turns, values = found
    return sum(dial.cause in GIVEN for dial, _ in values), turns


_Turned = tuple[Dial[Asked], float]


def _least(
    one: tuple[Dial[Asked], Array], two: tuple[Dial[Asked], Array], program: Program
) -> tuple[float, tuple[_Turned, _Turned]] | None:
    """Return the least sum of two relative turns, and the values that they lead to; None where they do not help."""
    chosen = (one, two)
    far = [dial.reach for dial, _ in chosen]
    decision = solved("least changes", with_turns(program, [column for _, column in chosen], far))
    if not decision.optimal:
        return None
    turns = np.maximum(decision.solution.x[-2:], 0.0)
    if turns.min() < NOTHING:
        return None  # one of them alone does it
    first, second = ((dial, dial.ahead(float(turn))) for (dial, _), turn in zip(chosen, turns, strict=True))
    return float(turns.sum()), (first, second)


def _planned(values: tuple[_Turned, _Turned], posed: Posed) -> tuple[Repair, Repair] | None:
    """Return two changes with which there is a verified plan; None when there is none."""
    for more in FARTHER if posed.analysis.grasp.held is not None else FARTHER[:1]:
        (one, first), (two, second) = ((dial, beyond(dial, value, more)) for dial, value in values)
        changed = one.turned(first)
        again = dials(changed, changed.timed, posed.analysis)
        both = next(each for each in again if (each.key, each.value) == (two.key, two.value)).turned(second)
        outcome = both.outcome()
        if isinstance(outcome, Plan):
            return Repair.of(one, first, outcome), Repair.of(two, second, outcome)
    return None
