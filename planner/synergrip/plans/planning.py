"""The main job: a grasp and a task in, a verified plan or a proof that there is none out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from synergrip.conic.certificate import judge_infeasible
from synergrip.conic.decide import Decision
from synergrip.conic.goals.goal import Goal
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.goals.least_peak import LeastPeak
from synergrip.conic.goals.least_reconfiguration import LeastReconfiguration
from synergrip.conic.limits.friction_cone import FrictionCone
from synergrip.conic.limits.limit import Limit
from synergrip.conic.limits.normal_force import NormalForce
from synergrip.conic.situation import Situation, situate
from synergrip.conic.solution import Claim
from synergrip.errors import NotRestrainedError, Refusal, SelfCheckError
from synergrip.grasps.grasp import Grasp
from synergrip.plans.analysis import Analysis, analyse
from synergrip.plans.limits_table import unbounded
from synergrip.plans.outcome import Infeasible, Outcome, Unknown
from synergrip.plans.question import SOLVERS, Answerer, Question, ask
from synergrip.plans.refusals import refusal_certificate
from synergrip.plans.task import Task
from synergrip.plans.tracking import rigid_coordinates
from synergrip.plans.units import units_of
from synergrip.plans.verified import verified_plan

SLACK = 1e-7
"""How much of a best value, in force units, the next goal may give up, so that its program has an interior."""


def plan(grasp: Grasp, task: Task, solver: Answerer = SOLVERS["clarabel"]) -> Outcome:
    """Plan a task: restraint, count, direction, magnitude, in this order (theory.md, section 7).

    Raises:
        InputError: the grasp is rigid in some contact direction, or the modes do not fit it.
        SelfCheckError: the answer failed the physical check (a defect of synergrip).
    """
    try:
        analysis = analyse(grasp, task.wrench)
    except NotRestrainedError as refusal:
        return _refused(grasp, task, None, refusal)
    try:
        beta = rigid_coordinates(analysis, task)
    except Refusal as refusal:
        return _refused(grasp, task, analysis, refusal)
    situation = situate(
        analysis.response, analysis.spaces, analysis.coordinates,
        times=task.times, wrench=task.wrench, beta=beta,
        units=units_of(analysis, task), redundancy=task.watches_references,
    )  # fmt: skip
    return _Planner(task, analysis, situation, solver).outcome()


def _refused(grasp: Grasp, task: Task, analysis: Analysis | None, refusal: Refusal) -> Infeasible:
    certificate = refusal_certificate(grasp, task, analysis, refusal)
    if not certificate.verified:
        raise SelfCheckError(f"the refusal does not verify ({refusal}); please report this problem")
    return Infeasible(task, analysis, refusal.stage, str(refusal), refusal, certificate, None, (), None)


class _Planner:
    """The order of the goals. Each decision made is kept, so that the outcome can show its work."""

    def __init__(self, task: Task, analysis: Analysis, situation: Situation, solver: Answerer) -> None:
        self.task, self.analysis, self.situation, self.solver = task, analysis, situation, solver
        self.decisions: list[Decision] = []

    def outcome(self) -> Outcome:
        if self.task.goal == "margin":
            return self._largest_margin()
        if self.task.goal == "peak_force":
            return self._least_peak()
        return self._least_effort(self.task.margin, self.task.limits)

    def _ask(self, limits: tuple[Limit, ...], goal: Goal) -> Decision:
        decision = ask(self.situation, limits, goal, self.solver)
        self.decisions.append(decision)
        return decision

    def _largest_margin(self) -> Outcome:
        first = self._ask(self.task.limits, LargestMargin())
        if not first.optimal:
            if first.solution.claim is Claim.UNBOUNDED:
                raise unbounded()
            return self._no_optimum(first)
        largest = float(first.solution.x[-1]) * self.situation.force_unit
        if largest < self.task.margin - SLACK * self.situation.force_unit:
            return self._short_of_margin(first, largest)
        margin = min(self.task.margin, largest) if largest <= self.task.margin else largest
        return self._least_effort(margin - SLACK * self.situation.force_unit, self.task.limits, largest, first)

    def _least_peak(self) -> Outcome:
        first = self._ask((FrictionCone(self.task.margin), *self.task.limits), LeastPeak())
        if not first.optimal:
            return self._without_optimum(first)
        unit = self.situation.force_unit
        peak = NormalForce(-np.inf, (float(first.solution.x[-1]) + SLACK) * unit, "goal.minimise")
        return self._least_effort(self.task.margin, (*self.task.limits, peak), fallback=first)

    def _least_effort(
        self, margin: float, limits: tuple[Limit, ...], largest: float | None = None, fallback: Decision | None = None
    ) -> Outcome:
        goal = LeastEffort("torque" if self.task.goal == "torque" else "contact")
        decision = self._ask((FrictionCone(margin), *limits), goal)
        if not decision.optimal and fallback is None:
            return self._without_optimum(decision)
        if not decision.optimal and fallback is not None:
            return Unknown(self.task, self.analysis, f"{goal.name} was not verified", tuple(self.decisions))
        decision = self._settle_redundancy(decision, (FrictionCone(margin), *limits))
        return verified_plan(self.task, self.analysis, self.situation, tuple(self.decisions), largest)

    def _settle_redundancy(self, decision: Decision, limits: tuple[Limit, ...]) -> Decision:
        """With the forces fixed, use no more redundancy than the reference limits force on the plan."""
        v = decision.program.unknowns(decision.solution.x)
        if v.shape[1] == self.situation.n_alpha:
            return decision
        return self._ask(tuple(x for x in limits if not isinstance(x, FrictionCone)), LeastReconfiguration(v))

    def _without_optimum(self, decision: Decision) -> Outcome:
        """Infeasible as claimed and proven, or proven by way of the largest margin, or unknown."""
        first = self._ask(self.task.limits, LargestMargin())
        largest = float(first.solution.x[-1]) * self.situation.force_unit if first.optimal else None
        if decision.infeasible:
            return self._infeasible(decision, decision, largest)
        if first.optimal and largest is not None and largest < self.task.margin:
            return self._short_of_margin(first, largest)
        return self._no_optimum(first)

    def _no_optimum(self, decision: Decision) -> Outcome:
        if decision.infeasible:
            return self._infeasible(decision, decision, None)
        why = f"{decision.solution.solver} says '{decision.solution.status}' and nothing verifies"
        return Unknown(self.task, self.analysis, why, tuple(self.decisions))

    def _short_of_margin(self, first: Decision, largest: float) -> Outcome:
        """The multipliers of the largest-margin program are the proof that the asked margin is out of reach."""
        limits = (*self.task.limits, FrictionCone(self.task.margin))
        program = Question(self.situation, limits, LeastEffort()).program()
        certificate = judge_infeasible(program, first.solution.z)
        proof = replace(first, program=program, certificate=certificate)
        if not proof.infeasible:
            why = f"the largest margin is {largest:.9g} N, too close to the {self.task.margin:.9g} N asked to be sure"
            return Unknown(self.task, self.analysis, why, tuple(self.decisions))
        return self._infeasible(proof, first, largest)

    def _infeasible(self, proof: Decision, decision: Decision, largest: float | None) -> Infeasible:
        why = "no internal force that the synergies control satisfies all limits at once"
        if largest is not None:
            asked = f"the task asks for {self.task.margin:.4g} N"
            why = f"these limits allow a slip margin of {largest:.4g} N at most; {asked}"
        return Infeasible(
            self.task, self.analysis, "magnitude", why, None, proof.certificate, proof.program,
            tuple(self.decisions), largest,
        )  # fmt: skip
