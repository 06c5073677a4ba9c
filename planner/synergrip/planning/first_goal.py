"""The first goal, which says whether there is a plan at all, and why not."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from synergrip.conic.conflicts import Conflict, beside_friction, conflicts
from synergrip.conic.decide import Decision
from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.slip_margin import SlipMargin
from synergrip.conic.question import Question
from synergrip.conic.relaxed import proof
from synergrip.documents.quantities import apart
from synergrip.log import LOG
from synergrip.planning.outcome import Infeasible, Outcome, Unknown
from synergrip.planning.solvers import Answered, Answerer, ask
from synergrip.planning.stages import Stage, begun, through
from synergrip.planning.verified import verified_plan
from synergrip.statics.analysis import Analysis
from synergrip.tasks.goals import unasked_goals
from synergrip.tasks.scaling import caps, grips
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.unbounded import unbounded

NEAR = 1e-5
"""Shortfall of a margin, relative to what the task asks of the contacts, that is a matter of digits."""


class Planner:
    """The first goal; the others follow by `stages`."""

    def __init__(
        self, task: TimedTask, analysis: Analysis, formulation: Formulation, solver: Answerer, *, brief: bool = False
    ) -> None:
        """Make the planner of a task on a grasp that can hold its object; `brief`: of a no it tells that it is one."""
        self.task, self.analysis, self.formulation, self.solver = task, analysis, formulation, solver
        self.brief = brief
        self.decisions: list[Decision] = []

    def outcome(self) -> Outcome:
        """Return the answer of the linear model at the start posture."""
        first, *others = self.task.goals
        LOG.info("first '%s': %d knots, %d unknowns each", first.name, self.formulation.knots, self.formulation.n_v)
        limits = self.task.kept if isinstance(first, LargestMargin) else self.task.all_limits
        best = self._ask(limits, first)
        if not best.decision.acceptable:
            return self._without_optimum(best.decision, first)
        stage = begun(best, limits, first)
        if stage.falls_short_of(self.task.margin):
            return self._short_of_margin(best, stage.largest_margin or 0.0)
        last = through(stage, others, unasked_goals(self.task), self.solver)
        return verified_plan(self.task, self.analysis, last, stage.largest_margin)

    def _ask(self, limits: tuple[Limit, ...], goal: Goal) -> Answered:
        answered = ask(Question(self.formulation, limits, goal), self.solver, self._sizes(goal))
        self.decisions.append(answered.decision)
        return answered

    def _sizes(self, goal: Goal) -> Iterator[float]:
        """Yield forces [N]: what the friction takes for the load; for the largest margin, what bounds it."""
        yield from grips(self.formulation)
        if isinstance(goal, LargestMargin):
            yield from caps(self.analysis, self.task)

    def _without_optimum(self, decision: Decision, goal: Goal) -> Outcome:
        """Infeasible as claimed and proven, or proven by way of the largest margin, or unknown."""
        if goal.has_scalar and decision.unbounded:
            raise unbounded(goal)
        if isinstance(goal, LargestMargin):
            return self._no_optimum(decision)
        if self.brief and decision.infeasible:
            return self._infeasible(decision, None)
        first = self._ask(self.task.kept, LargestMargin())
        widest = Stage(first.question.formulation, self.task.kept, LargestMargin(), (first.decision,))
        largest = widest.largest_margin if first.decision.optimal else None
        if decision.infeasible:
            return self._infeasible(decision, largest)
        if first.decision.infeasible:
            return self._infeasible(first.decision, None)
        if largest is not None and largest < self.task.margin:
            return self._short_of_margin(first, largest)
        return self._any_plan(goal)

    def _any_plan(self, goal: Goal) -> Outcome:
        """A plan that holds, when there is one and the best by the goal that was asked for is out of reach."""
        some = self._ask(self.task.all_limits, LeastEffort())
        if not some.decision.optimal:
            return self._no_optimum(some.decision)
        attempts = sum(each.attempts for each in self.decisions if each.goal == goal.name)
        note = (
            f"'{goal.name}' was not verified ({attempts} attempts), nor came any goal after it; this is the plan of "
            "least contact effort"
        )
        stage = Stage(some.question.formulation, self.task.all_limits, LeastEffort(), (some.decision,), (note,))
        return verified_plan(self.task, self.analysis, through(stage, (), unasked_goals(self.task), self.solver), None)

    def _no_optimum(self, decision: Decision) -> Outcome:
        if decision.infeasible:
            return self._infeasible(decision, None)
        why = f"{decision.solution.solver} says '{decision.solution.status}' and nothing verifies"
        return Unknown(self.task, self.analysis, why, tuple(self.decisions))

    def _short_of_margin(self, widest: Answered, largest: float) -> Outcome:
        """The multipliers of the largest-margin program are the proof that the asked margin is out of reach."""
        limits = (*self.task.kept, SlipMargin(self.task.margin))
        program = Question(widest.question.formulation, limits, LeastEffort()).program()
        certificate = proof(program, (widest.decision.solution.z,))
        if certificate.verified:
            return self._infeasible(replace(widest.decision, program=program, certificate=certificate), largest)
        asked = self._ask(limits, LeastEffort()).decision
        if asked.infeasible:
            return self._infeasible(asked, largest)
        near = self.task.margin - largest < NEAR * self.formulation.force_unit
        doubt = "too close to" if near else "and no proof verifies that it cannot be"
        why = (
            f"the largest margin is {largest:.9g} N, {doubt} the {self.task.margin:.9g} N asked" + near * " to be sure"
        )
        return Unknown(self.task, self.analysis, why, tuple(self.decisions))

    def _infeasible(self, proven: Decision, largest: float | None) -> Infeasible:
        ray = proven.certificate.y
        found = conflicts(proven.program, ray) if ray is not None else ()
        beside = "" if self.brief else f"; {self._without_limits()}"
        return Infeasible(
            self.task, self.analysis.grasp, self.analysis, "magnitude", self._shortfall(largest, found) + beside, None,
            proven.certificate, proven.program, tuple(self.decisions), largest, found,
        )  # fmt: skip

    def _shortfall(self, largest: float | None, found: Sequence[Conflict]) -> str:
        chief = beside_friction(found)
        if largest is None:
            named = f"; {chief} is what clashes most" if chief else ""
            return f"nothing that the synergies control keeps all limits at once{named}"
        if largest < 0:
            kept = f"as long as {chief} holds" if chief else "within these limits"
            return f"{kept} some contact slips: its friction cone is missed by {-largest:.4g} N or more"
        most, asked = apart(largest, self.task.margin)
        return f"these limits allow a slip margin of {most} N at most, the task asks for {asked} N"

    def _without_limits(self) -> str:
        """Tell limits from geometry: would the cones alone allow it?"""
        alone = Question(self.formulation, (SlipMargin(self.task.margin),), LeastEffort())
        free = ask(alone, self.solver, grips(self.formulation))
        if free.decision.infeasible:
            return "no squeeze however hard would do: friction, contact places, load or synergies must change"
        if not free.decision.optimal:
            return "whether a harder squeeze would do could not be verified"
        normal = free.question.formulation.force.at(free.v)[:, self.analysis.grasp.normal_rows].max()
        return f"for the friction cones alone {normal:.4g} N of normal force would do"
