"""How far a number may go on a hand that moves: by plans along the motion, between a value with and one without."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from synergrip.changes.asked import Asked
from synergrip.changes.at_a_value import between, outcome_at, with_room
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.limits.dial import Dial
from synergrip.planning.outcome import Outcome, Plan, Unknown
from synergrip.planning.pace import BRIEF, WHOLE, Effort
from synergrip.values import Value

NEARLY, WHOLE_WAY, NEARER = 0.97, 0.999, (0.4, 0.7)
"""Shares of the way to the extreme of the start posture that are tried on a hand that moves: first most of it, then all
but nothing of it where that has a plan, and the others where it has none."""
FARTHER = (1.1, 1.5)
"""Shares that are tried of a motion instead, where it has a plan at most of the way."""
NEAR, SHY, BACK, DOUBTED = 0.02, 2e-3, 0.03, 0.5
"""Shares of the number: how near each other a value with and one without a plan are at which nothing more is tried, how
far short of where the margin seems to end it is tried, how much shorter where that was too far all the same, and how
near a value of which a few passes find no plan is asked with all effort, and not one between."""


@dataclass(frozen=True, eq=False, repr=False)
class Search(Value):
    """Values of a number that were tried along the motion."""

    dial: Dial[Asked]
    end: float
    """Where the start posture ends."""
    good: float
    """The last one with a plan, `best`."""
    best: Plan
    without: tuple[float, ...] = ()
    """Those farther on without, the nearest last."""
    sure: bool = False
    """Whether planning says the same of the nearest one as it would be asked for: with all effort, or by a proof."""
    count: int = 0
    """How many values were tried."""
    lacks: tuple[tuple[float, float], ...] = ()
    """Values, and how much margin lacks there for what is asked [N], below 0 where there is more: where known."""

    @classmethod
    def of(cls, dial: Dial[Asked], end: float, plan: Plan) -> Search:
        """Return it where nothing was tried but the number as it is, which has a plan."""
        return cls(dial, end, dial.value, plan, lacks=_lacking(dial.value, plan))

    @property
    def bad(self) -> float | None:
        """The nearest value without a plan."""
        return self.without[-1] if self.without else None

    @property
    def gap(self) -> float:
        """How far the last value with a plan and the first without are from each other, as a share of the former."""
        return np.inf if self.bad is None else abs(self.good - self.bad) / abs(self.good)

    def over(self, tries: int) -> Search:
        """Return it after as many tries at most, from most of the way on."""
        moves = bool(np.any(self.best.task.target.values)) and self.dial.cause == "amplitude"
        search = self._with(self._at(NEARLY))
        for share in FARTHER if moves else (WHOLE_WAY,):
            if search.bad is None:
                search = search._with(search._at(share))
        return search.on(tries)

    def on(self, tries: int) -> Search:
        """Return it after as many tries at most, with those there were, or where values are near each other."""
        search = self
        while search.count < tries and search.bad is not None and search.gap > NEAR:
            search = search._with(search._next())
        return search

    def surely(self, tries: int) -> Search:
        """Return it after as many tries more at most with all effort, first of the nearest value without a plan.

        A few passes give up where more of them find a plan, so what they say of a value holds only once it is asked as
        `plan` asks it. Where they were wrong the next value without is doubted as well, and where none is left all but
        nothing of the way is tried.

        Args:
            tries: how often a value is planned with.
        """
        search = self
        for _ in range(tries):
            value = search._doubted() if search.without or not self.without else search._at(WHOLE_WAY)
            if value is None or (value - search.good) * np.sign(self.end - self.dial.value) <= SHY * abs(search.good):
                break
            search = search._with(value, WHOLE)
        return search

    def _doubted(self) -> float | None:
        """Return the value that is tried next with all effort; None where nothing is left to doubt."""
        if self.bad is None or (self.sure and self.gap <= NEAR):
            return None
        return self.bad if not self.sure and self.gap <= DOUBTED else between(self.good, self.bad)

    def told(self, name: Callable[[float], str]) -> str:
        """Return at which value no plan was found, and whether the search ends before values are near each other.

        Args:
            name: how a value is told.
        """
        if self.bad is None:
            return "; nothing farther was tried" if abs(self.end - self.good) > NEAR * abs(self.good) else ""
        how = "" if self.sure else " in a few passes"
        far = f"no more was tried after {self.count} plans, {100 * self.gap:.2g} % away from it"
        return f"; at {name(self.bad)} none was found{how}{f'; {far}' if self.gap > NEAR else ''}"

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

    def _with(self, value: float, effort: Effort = BRIEF) -> Search:
        value, count = value if value in self.without else self.dial.rounded(value), self.count + 1
        if value <= 0:
            return replace(self, count=count)
        outcome = outcome_at(self.dial, value, effort)
        lacks = (*self.lacks, *_lacking(value, outcome))
        if isinstance(outcome, Plan):
            left = tuple(bad for bad in self.without if (bad - value) * (bad - self.dial.value) > 0)
            sure = self.sure and left == self.without
            return replace(self, good=value, best=outcome, without=left, sure=sure, count=count, lacks=lacks)
        sure = effort is WHOLE or not isinstance(outcome, Unknown)
        without = (*(bad for bad in self.without if bad != value), value)
        return replace(self, without=without, sure=sure, count=count, lacks=lacks)


def _lacking(value: float, outcome: Outcome | None) -> tuple[tuple[float, float], ...]:
    """Return a value and how much margin lacks there; nothing where it was not the largest that was looked for."""
    if not isinstance(outcome, Plan | Unknown) or not outcome.usages:
        return ()
    if not isinstance(outcome.task.goal, LargestMargin):
        return ()
    lack = float(outcome.usages[0].excess.max())
    return ((value, lack),) if (lack <= 0) == isinstance(outcome, Plan) else ()
