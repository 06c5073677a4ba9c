"""What inscribed friction pyramids, as a quadratic program needs them, would cost. Never a part of the verdict.

The cones' verified plan is compared with the best plan by the same goals within the pyramids, which is found and
verified like any other: with what is the same program but for its facets, solved by Clarabel and certified. So the
figures are those of the pyramids and of no solver. A solver of quadratic programs then gets the first goal's program,
and the references it returns are judged like anybody's, as physics, with the true cones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from synergrip.conic.certificate import judge_infeasible
from synergrip.conic.decide import Decision
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import Effort, LeastEffort
from synergrip.conic.goals.weighted_sum import WeightedSum
from synergrip.conic.limits.limit import Limit
from synergrip.conic.pyramids import (
    FEWEST,
    FrictionPyramid,
    LargestMarginInPyramids,
    goal_in_pyramids,
    limit_in_pyramids,
)
from synergrip.conic.question import Question
from synergrip.conic.solution import Settings
from synergrip.conic.solvers import qpsolvers_
from synergrip.errors import Issue, SelfCheckError, one_of, raise_issues
from synergrip.planning.check import judged_at_start
from synergrip.planning.outcome import Check, Plan
from synergrip.planning.planning import plan_of_start_posture
from synergrip.planning.references import References
from synergrip.planning.solvers import SOLVERS, ask
from synergrip.planning.stages import Stage, through
from synergrip.planning.verified import verified_plan
from synergrip.tasks.goals import unasked_goals

MOST = 64
"""Facets: a pyramid of 64 is 0.12 % narrower than its cone, at most, and 64 rows for each contact and knot."""


@dataclass(frozen=True)
class Request:
    """What to compare with."""

    facets: int = 8
    backend: str = "osqp"


@dataclass(frozen=True)
class Answer:
    """What a solver of quadratic programs made of the first goal."""

    solver: str
    status: str
    """The solver's own word."""
    seconds: float
    checks: tuple[Check, ...]
    """Of the references it found, as physics; none when there are no references to judge."""
    gap: float
    """How far its value of the goal is from the best in the pyramids, relative; infinite when there is none."""

    @property
    def verified(self) -> bool:
        """True when its references keep everything that the task asks."""
        return bool(self.checks) and all(check.passed for check in self.checks)


@dataclass(frozen=True)
class Comparison:
    """A verified plan beside the best one within pyramids."""

    facets: int
    cones: Plan
    pyramids: Plan | None
    """The best plan by the same goals within the pyramids, verified."""
    rejected: bool | None
    """True: proven that no plan keeps the pyramids. None: neither found nor proven."""
    answer: Answer | None
    """None when the pyramids still leave no quadratic program."""
    other_cones: tuple[str, ...]
    """Keys of the limits that leave none."""

    @property
    def effort(self) -> Effort:
        """The kind of effort that is compared: the first that the goals speak of, contact effort if none does."""
        return next((goal.of for goal in _single(self.cones.task.goals) if isinstance(goal, LeastEffort)), "contact")

    @property
    def effort_ratio(self) -> float | None:
        """Effort within the pyramids over that within the cones; None without a plan or effort."""
        if self.pyramids is None:
            return None
        return _ratio(_effort(self.pyramids, self.effort), _effort(self.cones, self.effort))

    @property
    def peak_ratio(self) -> float | None:
        """Largest normal force within the pyramids over that within the cones; None without a plan or force."""
        return None if self.pyramids is None else _ratio(_peak(self.pyramids), _peak(self.cones))

    @property
    def margin(self) -> float | None:
        """Smallest true slip margin of the plan within the pyramids [N]."""
        return None if self.pyramids is None else float(self.pyramids.margins.min())

    @property
    def time_ratio(self) -> float | None:
        """Time of the quadratic program over that of the cone program of the same goal."""
        return None if self.answer is None else _ratio(self.answer.seconds, self.cones.decisions[0].solution.seconds)


def requested(facets: int, backend: str = "osqp") -> Request:
    """Return what to compare with.

    Raises:
        InputError: too few or too many facets, or a backend that is not installed.
    """
    issues = []
    if not FEWEST <= facets <= MOST:
        issues.append(Issue(f"expected {FEWEST} to {MOST} facets for each friction cone, got {facets}", "--pyramids"))
    if backend not in qpsolvers_.backends():
        found = one_of(backend, qpsolvers_.backends())
        issues.append(Issue(f"{found}; install the solver for qpsolvers to find it", "--qp-solver"))
    raise_issues(issues)
    return Request(facets, backend)


def compare(plan: Plan, request: Request) -> Comparison | None:
    """Return what pyramids in the friction cones' place would make of a plan. The plan is not changed by it.

    Both are those of the linear model at the start posture, so that nothing but the cones differs;
    None when that has no plan, and the one given goes where only the hand that moves does.
    """
    facets = request.facets
    cones = plan if plan.executed is None else plan_of_start_posture(plan.analysis, plan.task)
    if not isinstance(cones, Plan):
        return None
    question = _question(cones, facets)
    answered = ask(question, SOLVERS["clarabel"])
    question, decision = answered.question, answered.decision
    pyramids = _best(cones, question, decision, facets)
    rejected = False if pyramids is not None else True if _excluded(cones, question, decision, facets) else None
    others = qpsolvers_.other_cones(decision.program)
    answer = None if others else _answer(cones, question, decision, request.backend)
    return Comparison(facets, cones, pyramids, rejected, answer, others)


def _question(cones: Plan, facets: int) -> Question:
    """Return the first goal's question, with pyramids."""
    task, goal = cones.task, goal_in_pyramids(cones.task.goal, facets)
    kept = _kept(cones, facets)
    limits = kept if isinstance(goal, LargestMargin) else (FrictionPyramid(task.margin, facets=facets), *kept)
    return Question(cones.formulation, limits, goal)


def _kept(cones: Plan, facets: int) -> tuple[Limit, ...]:
    return tuple(limit_in_pyramids(limit, facets) for limit in cones.task.kept)


def _best(cones: Plan, question: Question, first: Decision, facets: int) -> Plan | None:
    """Return the best plan within the pyramids by all the goals; None when none is found."""
    task, clarabel = cones.task, SOLVERS["clarabel"]
    if not first.optimal:
        return None
    stage = Stage(question.formulation, question.limits, question.goal, (first,))
    if stage.falls_short_of(task.margin):
        return None
    goals = [goal_in_pyramids(goal, facets) for goal in task.goals[1:]]
    last = through(stage, goals, unasked_goals(task), clarabel)
    if last.interrupted:  # half of the goals would compare nothing
        raise KeyboardInterrupt
    try:
        return verified_plan(task, cones.analysis, last, stage.largest_margin)
    except SelfCheckError:  # of a comparison: the verdict has its own
        return None


def _excluded(cones: Plan, question: Question, first: Decision, facets: int) -> bool:
    """Return whether it is proven that no plan keeps the pyramids: by a ray, or by too small a largest margin."""
    if first.infeasible:
        return True
    kept = _kept(cones, facets)
    if not isinstance(question.goal, LargestMargin):
        widest = Question(question.formulation, kept, LargestMarginInPyramids(facets=facets))
        answered = ask(widest, SOLVERS["clarabel"])
        question, first = answered.question, answered.decision
    if not first.optimal:
        return first.infeasible
    asked = Question(question.formulation, (*kept, FrictionPyramid(cones.task.margin, facets=facets)), LeastEffort())
    return judge_infeasible(asked.program(), first.solution.z).verified


def _answer(cones: Plan, question: Question, best: Decision, backend: str) -> Answer:
    """Return what a solver of quadratic programs finds, and what becomes of it. Its status decides nothing."""
    program, task, analysis = best.program, cones.task, cones.analysis
    found = qpsolvers_.solve(program, Settings(), backend)
    checks: tuple[Check, ...] = ()
    gap = np.inf
    with np.errstate(all="ignore"):  # whatever the numbers are, they are judged
        dz_r = analysis.coordinates.references(*question.formulation.parts(program.unknowns(found.x)))
        if np.all(np.isfinite(dz_r)):
            checks = judged_at_start(analysis, task, References(task.times, dz_r, {}), task.times).checks
            if best.optimal:
                reached, least = program.objective(found.x), program.objective(best.solution.x)
                gap = abs(reached - least) / max(1.0, abs(reached), abs(least))
    return Answer(found.solver, found.status, found.seconds, checks, gap)


def _single(goals: Iterable[Goal]) -> Iterator[Goal]:
    """Yield goals, those of a weighted sum one by one."""
    for goal in goals:
        yield from (_single(each for each, _ in goal.goals) if isinstance(goal, WeightedSum) else (goal,))


def _effort(plan: Plan, kind: Effort) -> float:
    """Return the sum of squares that `LeastEffort` of a kind minimises, in SI units."""
    scale, motion = plan.analysis.response.scale, plan.motion
    values = {
        "contact": motion.forces * scale.force, "torque": motion.torques / scale.length,
        "actuator": motion.efforts / scale.length,
    }  # fmt: skip
    return float((values[kind] ** 2).sum())


def _peak(plan: Plan) -> float:
    """Return the largest normal force [N]."""
    return float(plan.motion.forces[:, plan.analysis.grasp.normal_rows].max())


def _ratio(value: float, reference: float) -> float | None:
    return value / reference if reference > 0 else None
