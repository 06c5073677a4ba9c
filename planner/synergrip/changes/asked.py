"""What was asked, as a value of which single numbers can be changed, and the program that decides it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from synergrip.conic.build import Constraints
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.program import Program
from synergrip.conic.question import Question
from synergrip.conic.units import Units
from synergrip.errors import SynergripError
from synergrip.grasps.grasp import Grasp
from synergrip.planning.formulated import formulated
from synergrip.planning.instants import intersample_of
from synergrip.planning.outcome import Outcome, Plan
from synergrip.planning.pace import WHOLE, Effort
from synergrip.planning.planning import planned_with
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.restraint import NO_LOAD
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.timing import at_start
from synergrip.values import Value

MANY, FEWER = 4, 5
"""Instants between the knots for each knot from which on some of them are looked at first: each fifth."""
STATED = "other numbers are planned without allow.scenarios, for the grasp as it is stated: each takes many plans"


@dataclass(frozen=True, eq=False, repr=False)
class Asked(Value):
    """A grasp and a task, all limits among its limits: the slip margin, and what the hand states."""

    grasp: Grasp
    task: Task | TimedTask
    at_corners: bool = False
    """Whether its program asks between the knots at the corners of loads and wishes alone, without any reserve: then
    there is none of the task where that has no answer."""

    @classmethod
    def of(cls, grasp: Grasp, task: Task | TimedTask, timed: TimedTask, *, scenarios: bool = False) -> Asked:
        """Return what was asked, limits filled in.

        Args:
            grasp: who plans.
            task: as it was asked.
            timed: the same at its knots.
            scenarios: whether to ask for those on a hand, too, of which each plan takes many.
        """
        asked = task if scenarios or grasp.held is None else _without_scenarios(task)
        return cls(grasp, asked).with_limits((SlipMargin(timed.margin), *timed.limits))

    @property
    def limits(self) -> tuple[Limit, ...]:
        """All limits, the slip margin among them."""
        task = self.task
        return (SlipMargin(task.margin), *task.limits) if isinstance(task, TimedTask) else tuple(task.limits)

    def with_limits(self, limits: tuple[Limit, ...]) -> Asked:
        """Return the same within other limits."""
        return self.with_task(limits=limits, **({"margin": 0.0} if isinstance(self.task, TimedTask) else {}))

    def with_task(self, **changes: Any) -> Asked:
        """Return the same with other arguments of the task."""
        return replace(self, task=replace(self.task, **changes))

    @property
    def sharp(self) -> Asked:
        """The same as a program that asks for no more than what is needed, if not for all of it."""
        return replace(self, at_corners=True)

    @property
    def timed(self) -> TimedTask:
        """The task at its knots."""
        return self.task.timed(self.grasp) if isinstance(self.task, Task) else self.task.on(self.grasp)

    @property
    def executes_samples(self) -> bool:
        """Whether each plan takes many executions: of samples of a grasp on a hand."""
        allowed = self.task.allow if isinstance(self.task, Task) else self.task.allowed
        return self.grasp.held is not None and allowed is not None and allowed.scenarios is not None

    def outcome(self, effort: Effort = WHOLE) -> Outcome | None:
        """Return what planning with an effort says of it; None where it is refused as bad input.

        Raises:
            KeyboardInterrupt: somebody interrupted, be it where a plan of some goals was there already.
        """
        try:
            found = planned_with(effort, self.grasp, self.task)
        except SynergripError:
            return None
        if isinstance(found, Plan) and found.interrupted:
            raise KeyboardInterrupt
        return found

    def posed(self, known: Analysis | None = None, units: Units | None = None, *, every: bool = False) -> Posed | None:
        """Return the program of the start posture; None where the task is refused before there is one.

        Args:
            known: an analysis of a grasp with the same matrices, not to be made again.
            units: of its unknowns; those that suit the task when None.
            every: whether what is held between the knots is asked at every instant that is looked at, and what is
                allowed for in every case, and not by reserves: these ask for more than is needed, so that without an
                answer nothing is proven.
        """
        try:
            timed = self.timed
            grasp = at_start(self.grasp, timed.wrench[0])
            analysis = analyse(grasp, NO_LOAD) if known is None else known.begun(grasp)
            formulation = formulated(analysis, timed, redundancy=timed.watches_references)
        except SynergripError:
            return None
        held = intersample_of(timed, analysis) if timed.between == "hold" else None
        if held is not None and (every or self.at_corners):
            held = held.at_corners() if self.at_corners else held.every()
        formulation = replace(formulation, intersample=held)
        if (every or self.at_corners) and formulation.allowed is not None:
            formulation = replace(formulation, allowed=formulation.allowed.exact)
        formulation = formulation if units is None else formulation.in_units(units)
        return Posed(analysis, timed, formulation)


def _without_scenarios(task: Task | TimedTask) -> Task | TimedTask:
    """Return a task that allows for what is guaranteed alone."""
    if isinstance(task, Task):
        return task if task.allow is None else replace(task, allow=task.allow.without_scenarios)
    return task if task.allowed is None else replace(task, allowed=replace(task.allowed, scenarios=None))


@dataclass(frozen=True, eq=False, repr=False)
class Posed(Value):
    """A task as a program at the start posture."""

    analysis: Analysis
    timed: TimedTask
    formulation: Formulation

    @property
    def strict(self) -> bool:
        """Whether the program asks for no more than the task: without an answer it proves that there is no plan."""
        between, allowed = self.formulation.intersample, self.formulation.allowed
        return (between is None or between.exact) and not (allowed is not None and allowed.asks_more)

    @property
    def at_knots(self) -> Posed:
        """The same where nothing is asked between the knots: without an answer there is none to the whole, either."""
        return replace(self, formulation=replace(self.formulation, intersample=None))

    @property
    def at_fewer(self) -> Posed | None:
        """The same where only some instants between the knots are looked at; None where there are few anyhow.

        Without an answer there is none to the whole, either.
        """
        between = self.formulation.intersample
        if between is None or not between.exact or between.corner.sum() < MANY * (~between.corner).sum():
            return None
        keep = ~between.corner | (np.arange(len(between.corner)) % FEWER == 0)
        fewer = replace(between, grid=between.grid.of(keep), corner=between.corner[keep])
        return replace(self, formulation=replace(self.formulation, intersample=fewer))

    def program(self) -> Program:
        """Return the program of least effort within all limits."""
        return self._question.program()

    def constraints(self) -> Constraints:
        """Return the rows of that program alone."""
        return self._question.constraints()

    @property
    def _question(self) -> Question:
        return Question(self.formulation, self.timed.all_limits, LeastEffort())
