"""How far a number may go on a hand that moves: by plans along the motion, between a value with and one without."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import between, outcome_at, with_room
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.dial import Dial
from synergrip.planning.outcome import Outcome, Plan, Unknown
from synergrip.planning.pace import BRIEF
from synergrip.values import Value

NEARLY, WHOLE_WAY, NEARER = 0.97, 0.999, (0.4, 0.7)
"""Shares of the way to the extreme of the start posture that are tried on a hand that moves: first most of it, then all
but nothing of it where that has a plan, and the others where it has none."""
FARTHER = (1.1, 1.5)
"""Shares that are tried of a motion instead, where it has a plan at most of the way."""
NEAR, SHY, BACK = 0.02, 2e-3, 0.03
"""Shares of the number: how near each other a value with and one without a plan are at which nothing more is tried, how
far short of where the margin seems to end it is tried, and how much shorter where that was too far all the same."""


@dataclass(frozen=True, eq=False, repr=False)
class Search(Value):
    """Values of a number that were tried along the motion."""

    dial: Dial[Asked]
    end: float
    """Where the start posture ends."""
    good: float
    """The last one with a plan, `best`."""
    best: Plan
    bad: float | None = None
    """The nearest one without."""
    count: int = 0
    """How many values were tried."""
    lacks: tuple[tuple[float, float], ...] = ()
    """Values, and how much margin lacks there for what is asked [N], below 0 where there is more: where known."""

    @classmethod
    def of(cls, dial: Dial[Asked], end: float, plan: Plan) -> Search:
        """Return it where nothing was tried but the number as it is, which has a plan."""
        return cls(dial, end, dial.value, plan, lacks=_lacking(dial.value, plan))

    def over(self, tries: int) -> Search:
        """Return it after as many tries at most, from most of the way on."""
        moves = bool(np.any(self.best.task.target.values)) and self.dial.cause == "amplitude"
        search = self._with(self._at(NEARLY))
        for share in FARTHER if moves else (WHOLE_WAY,):
            if search.bad is None:
                search = search._with(search._at(share))
        return search.on(tries)

    def on(self, tries: int, apart: float = NEAR) -> Search:
        """Return it after as many tries at most, with those there were, or where values are near each other.

        Args:
            tries: how often a value is planned with.
            apart: how far a value with a plan and one without may be from each other, as a share of the number.
        """
        search = self
        while search.count < tries and search.bad is not None:
            if abs(search.good - search.bad) <= apart * abs(search.good):
                break
            search = search._with(search._next())
        return search

    def _next(self) -> float:
        """Return the value that is tried next: where the margin ends, if that can be told."""
        assert self.bad is not None
        if (guess := self._guess()) is not None:
            return guess
        known, short = dict(self.lacks), self.dial.easier(self.bad, BACK * abs(self.bad))
        if self.bad not in known and max(known.values(), default=0.0) > 0 and self._inside(short):
            return short
        left = [value for value in map(self._at, NEARER) if self._inside(value)]
        return left[len(left) // 2] if left else between(self.good, self.bad)

    def _guess(self) -> float | None:
        """Return about where the margin that is asked for ends, by a line through two values; None where unknown."""
        assert self.bad is not None
        known = dict(self.lacks)
        without = [value for value, lack in self.lacks if lack > 0]
        pairs = [tuple(without[-2:]), (self.good, self.bad)]
        step = NEAR / 2 * abs(self.good) * np.sign(self.bad - self.good)
        for pair in pairs:
            if len(pair) < 2 or not all(value in known for value in pair):
                continue
            (first, second), (much, less) = pair, (known[value] for value in pair)
            zero = second - less * (second - first) / (less - much) if less != much else np.inf
            if self._inside(zero):
                ends = sorted((self.good + step, self.bad - step))
                return float(np.clip(self.dial.easier(zero, SHY * abs(zero)), *ends))
        return None

    def _inside(self, value: float) -> bool:
        """Return whether a value, as it is told, lies between those with and without a plan."""
        value = self.dial.rounded(value) if np.isfinite(value) else value
        return self.bad is not None and min(self.good, self.bad) < value < max(self.good, self.bad)

    def _at(self, share: float) -> float:
        """Return the value at a share of the way from what is asked to the end of the start posture."""
        return with_room(self.dial, self.dial.value + share * (self.end - self.dial.value))

    def _with(self, value: float) -> Search:
        value, count = self.dial.rounded(value), self.count + 1
        if value <= 0:
            return replace(self, count=count)
        outcome = outcome_at(self.dial, value, BRIEF)
        lacks = (*self.lacks, *_lacking(value, outcome))
        if isinstance(outcome, Plan):
            return replace(self, good=value, best=outcome, count=count, lacks=lacks)
        return replace(self, bad=value, count=count, lacks=lacks)


def _lacking(value: float, outcome: Outcome | None) -> tuple[tuple[float, float], ...]:
    """Return a value and how much margin lacks there; nothing where it was not the largest that was looked for."""
    if not isinstance(outcome, Plan | Unknown) or not outcome.usages:
        return ()
    if not isinstance(outcome.task.goal, LargestMargin):
        return ()
    lack = float(outcome.usages[0].excess.max())
    return ((value, lack),) if (lack <= 0) == isinstance(outcome, Plan) else ()
