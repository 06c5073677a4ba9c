"""The end of a number of many tasks: tried in growing steps until plan and proof are on its two sides, then between."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from synergrip.batch.asked import Asked
from synergrip.batch.many_margins import ENDLESS, FOUND, NONE, UNFINISHED, UNKNOWN, ManyMargins
from synergrip.batch.many_plans import FEASIBLE, INFEASIBLE, ManyPlans
from synergrip.batch.plan_many import answered
from synergrip.batch.telling import Telling
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.errors import InputError
from synergrip.grasps.stack import GraspStack
from synergrip.linalg import Array

CLOSE = 4e-7
"""Share of a number that may be left between a value with a plan and one that is proven to have none."""
STEP = 4.0
HARDER = tuple(range(1, 13))
"""Powers of `STEP` that are tried in turn where the task has a plan."""
EASIER, MORE_FRICTION = (1, 2, 4, 8), (1, 2, 4)
"""Those toward an easier task where it has none: of load and mass, and of friction, where more is no friction known."""
MOST = 60
"""Times that values are tried between two ends; nearly all numbers are found in 12."""
USUAL = 16
"""Times that values are tried in all, for telling how far it is."""
Turned = Callable[[Asked, NDArray[np.intp], Array], Asked]
"""Tasks that stand at some places of all, with their number multiplied by a factor each."""


@dataclass
class Tried:
    """What becomes of tasks at other values of the number."""

    question: Asked
    turned: Turned
    tell: Telling
    options: dict[str, Any]
    goal: Goal | None = None
    """The largest margin, whose value tells how far the end is; the least effort where nothing bounds that."""

    def __call__(self, places: NDArray[np.intp], factors: Array) -> tuple[ManyPlans, bool]:
        """Return answers to the tasks at some places, and whether somebody interrupted."""
        question = self.question
        whose = question.grasp.taken(places) if isinstance(question.grasp, GraspStack) else question.grasp
        friction = None if question.friction is None else question.friction[places]
        own = replace(question, grasp=whose, wrench=question.wrench[places], friction=friction)
        own = self.turned(own, places, factors)
        if self.goal is None:
            try:
                found = self._answered(own, LargestMargin())
            except InputError as error:
                if error.issues[0].key != "goal.maximise":
                    raise
                self.goal = LeastEffort()
            else:
                self.goal = LargestMargin()
                return found
        return self._answered(own, self.goal)

    def _answered(self, own: Asked, goal: Goal) -> tuple[ManyPlans, bool]:
        own = replace(own, task=replace(own.task, goals=(goal,)))
        return answered(own, tell=self.tell, level=logging.DEBUG, **self.options)


class Search:
    """Ends of N numbers as factors of what they are, narrower with every value that is tried."""

    def __init__(self, of: str, begun: Array, tell: Telling) -> None:
        """Begin with nothing known; `begun` is (N,) the numbers as they are."""
        N = len(begun)
        self.of, self.begun, self._tell = of, begun, tell
        self.good, self.bad, self.at_good, self.at_bad = (np.full(N, np.nan) for _ in range(4))
        self.ends: NDArray[np.str_] = np.full(N, UNFINISHED, dtype="<U10")
        self.verdicts: NDArray[np.str_] = np.full(N, UNKNOWN, dtype="<U10")
        self.turns, self.kernel = 0, ""

    def heard(self, what: str, share: float) -> None:
        """Tell how far it is, from the share that is done of the values under way."""
        if what != "planning":
            self._tell(what, share)
            return
        left = float((self.ends == UNFINISHED).mean()) * (1 - min((self.turns + share) / USUAL, 0.95))
        self._tell(f"finding {self.of}", 1 - left)

    def run(self, tried: Tried) -> ManyMargins:
        """Return what is found; what is left open at an interrupt is unfinished."""
        friction = self.of == "critical_friction_scale"
        try:
            self._enclose(tried, 1 / STEP if friction else STEP, MORE_FRICTION if friction else EASIER)
            self._narrow(tried)
            self._tell(f"finding {self.of}", 1.0)
        except KeyboardInterrupt:
            pass
        return self._told()

    def _enclose(self, tried: Tried, harder: float, easier: tuple[int, ...]) -> None:
        """Find a value with a plan and one with a proof of each, from what it is on."""
        N = len(self.begun)
        begins, many = self._try(tried, np.arange(N), np.ones(N))
        self.verdicts[many.verified] = many.verdicts[many.verified]
        self.ends[many.clashes == "restraint"] = NONE
        for turn, power in enumerate(HARDER):
            lighter = -easier[turn] if turn < len(easier) else 0
            self.ends[self._one_sided(self.bad) & (lighter == 0)] = NONE
            places = np.flatnonzero(self._one_sided(self.good) | self._one_sided(self.bad))
            if not len(places):
                return
            self._try(tried, places, harder ** np.where(begins[places] > 0, power, lighter).astype(float))
        self.ends[self._one_sided(self.good)] = ENDLESS

    def _one_sided(self, end: Array) -> NDArray[np.bool_]:
        """Return (N,) whose end of this side alone is known, and are open."""
        both = np.isfinite(self.good) & np.isfinite(self.bad)
        return np.asarray((self.ends == UNFINISHED) & np.isfinite(end) & ~both)

    def _narrow(self, tried: Tried) -> None:
        """Bring the ends of each together."""
        good, bad = self.good, self.bad
        for turn in range(MOST):
            with np.errstate(invalid="ignore"):
                self.ends[(self.ends == UNFINISHED) & (np.abs(bad - good) <= CLOSE * good)] = FOUND
            open_ = np.flatnonzero(self.ends == UNFINISHED)
            if not len(open_):
                return
            ends = (each[open_] for each in (good, bad, self.at_good, self.at_bad))
            self._try(tried, open_, between(*ends, halve=turn % 4 == 3))
        self.ends[self.ends == UNFINISHED] = FOUND

    def _try(self, tried: Tried, places: NDArray[np.intp], factors: Array) -> tuple[NDArray[np.int8], ManyPlans]:
        """Try a value of each; return 1, -1 or 0 for a plan, a proof or neither.

        Raises:
            KeyboardInterrupt: somebody interrupted; what is finished is kept.
        """
        many, interrupted = tried(places, factors)
        signs = (many.verdicts == FEASIBLE).astype(np.int8) - (many.verdicts == INFEASIBLE)
        signs = np.where(many.verified, signs, 0)
        beyond = many.largest_margin - tried.question.task.margin
        for sign, end, at in ((1, self.good, self.at_good), (-1, self.bad, self.at_bad)):
            end[places[signs == sign]], at[places[signs == sign]] = factors[signs == sign], beyond[signs == sign]
        both = np.isfinite(self.good[places]) & np.isfinite(self.bad[places])
        self.ends[places[many.finished & (signs == 0)]] = np.where(both, FOUND, UNKNOWN)[many.finished & (signs == 0)]
        self.turns, self.kernel = self.turns + 1, many.kernel
        if interrupted:
            raise KeyboardInterrupt
        return signs, many

    def _told(self) -> ManyMargins:
        value, other = self.good * self.begun, self.bad * self.begun
        value[~np.isfinite(other)] = other[~np.isfinite(value)] = np.nan
        with np.errstate(invalid="ignore"):
            proven = np.abs(other - value) <= 1e-6 * value
        return ManyMargins(
            self.of, value, np.fmin(value, other), np.fmax(value, other), proven, self.ends, self.verdicts, self.kernel
        )


def between(good: Array, bad: Array, at_good: Array, at_bad: Array, *, halve: bool) -> Array:
    """Return factors to try next: where the margin ends on a straight line, a little on toward the end farther off."""
    middle = np.sqrt(good * bad)
    if halve:
        return middle
    with np.errstate(all="ignore"):
        zero = good + (bad - good) * at_good / (at_good - at_bad)
    far = np.where(np.abs(zero - good) > np.abs(zero - bad), good, bad)
    zero = zero + np.sign(far - zero) * 0.4 * CLOSE * good
    inside = (zero - good) * (bad - zero) > 0
    return np.where(inside, zero, middle)
