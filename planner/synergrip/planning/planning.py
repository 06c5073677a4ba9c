"""The main job: a grasp and a task in, a verified plan or a proof that there is none out."""

from __future__ import annotations

from dataclasses import replace

from synergrip.conic.formulation import Formulation
from synergrip.conic.goals.largest_margin import LargestMargin
from synergrip.conic.goals.least_effort import LeastEffort
from synergrip.conic.well_formed import refuse_malformed
from synergrip.documents.naming import naming_arguments
from synergrip.errors import InputError, NotRestrainedError, Refusal, SelfCheckError, kind_of
from synergrip.grasps.chosen_tangents import tangent_notes
from synergrip.grasps.grasp import Grasp
from synergrip.grasps.plausible import grasp_doubts
from synergrip.grasps.straight_fingers import straight_notes
from synergrip.log import LOG
from synergrip.planning.accuracy import InDoubtError, refuse_doubtful_response
from synergrip.planning.first_goal import Planner
from synergrip.planning.formulated import formulated
from synergrip.planning.holding import held
from synergrip.planning.in_balance import in_balance
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.planning.pace import WHOLE, Effort
from synergrip.planning.refusals import refusal_certificate
from synergrip.planning.reversed_normals import with_hint
from synergrip.planning.solvers import SOLVERS, Answerer, answerer
from synergrip.planning.springs import limits_with_springs
from synergrip.statics.analysis import Analysis, analyse
from synergrip.statics.restraint import NO_LOAD
from synergrip.statics.unbalanced_springs import unbalanced_notes
from synergrip.tasks.plausible import task_doubts
from synergrip.tasks.task import Task
from synergrip.tasks.timed_task import TimedTask
from synergrip.tasks.timing import at_start


@naming_arguments
def plan(grasp: Grasp | Analysis, task: Task | TimedTask, solver: str | Answerer = "clarabel") -> Outcome:
    """Plan a task: restraint, count, direction, magnitude, in this order (docs/theory.md).

    A hand holds the load of the first instant when the task begins; a grasp given as matrices holds its w_0. What comes
    out on a hand is executed before it is shown, and its figures are those of the true equilibria (docs/along.md).

    Args:
        grasp: who plans; its `Analysis` instead, when the same grasp is planned many times.
        task: what is asked.
        solver: "clarabel" (for long trajectories after a method of our own, docs/performance.md), or "cvxpy" for the
            second formulation of the same problem at the start posture (passes along the motion are "clarabel"'s); or a
            function that answers.

    Returns:
        A verified `Plan`, an `Infeasible` with its proof, or `Unknown` when nothing can be trusted.

    Raises:
        InputError: an argument of another type, loads that do not fit the task or the grasp, no such solver; the grasp
            is rigid in some contact direction, or modes, limits or goals do not fit it.
        SelfCheckError: the answer failed the physical check (a defect of synergrip).

    Example:
        >>> from synergrip import load_problem
        >>> problem = load_problem("pinch-soft")
        >>> plan(problem.grasp, problem.task).verdict
        'feasible'
    """
    outcome = planned_with(WHOLE, grasp, task, solver)
    LOG.info("%r", outcome)
    asked = outcome.grasp
    said = (*unbalanced_notes(asked), *tangent_notes(asked), *straight_notes(asked))
    doubts = (*said, *grasp_doubts(asked), *task_doubts(task, outcome.task, asked))
    if not isinstance(outcome, Plan):
        of_springs = limits_with_springs(outcome.grasp, outcome.task)
        return replace(outcome, asked=task, notes=(*outcome.notes, *of_springs, *map(str, doubts)))
    return replace(outcome, notes=(*outcome.notes, *map(str, doubts))) if doubts else outcome


def planned_with(
    effort: Effort, grasp: Grasp | Analysis, task: Task | TimedTask, solver: str | Answerer = "clarabel"
) -> Outcome:
    """Return the answer that an effort along the motion comes to; other arguments as of `plan`."""
    answers = answerer(solver, "solver")
    begins = _begun_briefly if effort.brief else plan_of_start_posture
    return planned_along(begins(grasp, task, answers), answers, effort)


def planned_along(outcome: Outcome, answers: Answerer, effort: Effort) -> Outcome:
    """Return the answer about the hand that moves, where there is one, of that of the start posture."""
    return in_balance(_along(outcome, answers, effort))


def _along(outcome: Outcome, answers: Answerer, effort: Effort) -> Outcome:
    analysis = outcome.analysis
    if outcome.grasp.held is None or not (analysis is None or analysis.response.restrained):
        return outcome  # an object that is free to move has no stiffness there, and no true equilibrium to look for
    if isinstance(outcome, Plan):
        from synergrip.planning.walked import on_the_hand

        return on_the_hand(outcome, answers, effort)
    if isinstance(outcome, Infeasible) and not effort.brief:
        from synergrip.planning.going_on import gone_on

        return gone_on(outcome, lambda analysis, task: _planned(analysis, task, answers), answers, effort)
    return outcome


def plan_of_start_posture(
    grasp: Grasp | Analysis, task: Task | TimedTask, solver: str | Answerer = "clarabel"
) -> Outcome:
    """Return what the linear model says, with contacts, G and J as they are at the start; arguments as of `plan`."""
    answers = answerer(solver, "solver")
    known, asked = _judged(grasp, task)
    analysis = known if isinstance(known, Analysis) else analyse(known, NO_LOAD)
    return _planned(analysis, asked, answers)


def _begun_briefly(grasp: Grasp | Analysis, task: Task | TimedTask, answers: Answerer) -> Outcome:
    """Return the plan of least effort of the start posture where the largest margin is wanted and passes go on from it.

    Where they do not, and for other goals, it is the plan for the goals of the task.
    """
    known, asked = _judged(grasp, task)
    analysis = known if isinstance(known, Analysis) else analyse(known, NO_LOAD)
    if analysis.grasp.held is None or asked.linearise == "once" or not isinstance(asked.goal, LargestMargin):
        return _planned(analysis, asked, answers, brief=True)
    found = _planned(analysis, replace(asked, goals=(LeastEffort(),)), answers, brief=True)
    if isinstance(found, Plan):
        return replace(found, task=asked, largest_margin=float(found.margins.min()))
    return replace(found, task=asked)


def _judged(grasp: Grasp | Analysis, task: Task | TimedTask) -> tuple[Grasp | Analysis, TimedTask]:
    """Return the grasp as it is when the task begins, and the task at its knots."""
    if not isinstance(grasp, Grasp | Analysis):
        hint = "; write problem.grasp, problem.task" if hasattr(grasp, "grasp") and hasattr(grasp, "task") else ""
        raise InputError.at("grasp", f"expected a Grasp or an Analysis, got {kind_of(grasp)}{hint}")
    if not isinstance(task, Task | TimedTask):
        raise InputError.at("task", f"expected a Task, got {kind_of(task)}")
    whole = grasp.grasp if isinstance(grasp, Analysis) else grasp
    timed = task.timed(whole) if isinstance(task, Task) else task.on(whole)
    begins = at_start(whole, timed.wrench[0])
    if begins is whole:
        return grasp, timed
    return grasp.begun(begins) if isinstance(grasp, Analysis) else begins, timed


def _planned(analysis: Analysis, task: TimedTask, solver: Answerer, *, brief: bool = False) -> Outcome:
    """Plan a task on a grasp, as far as it can hold its object; `brief`: of a no it is told that it is one, no more."""
    grasp = analysis.grasp
    LOG.info("planning on %d contacts with %d synergies: %r", grasp.n_c, grasp.n_z, task)
    LOG.info("%r", analysis)
    try:
        formulation = formulated(analysis, task, redundancy=task.watches_references)
    except Refusal as refusal:
        return _refused(grasp, task, analysis, refusal)
    refuse_malformed(task.limits, task.goals, formulation)
    planners: list[Planner] = []

    def answer(asked: TimedTask, each: Formulation) -> Outcome:
        planners.append(Planner(asked, analysis, each, solver, brief=brief))
        return planners[-1].outcome()

    try:
        refuse_doubtful_response(analysis.response)
        outcome = held(task, analysis, formulation, answer)
        return outcome if brief else with_hint(outcome, _again)
    except InDoubtError as doubt:
        decisions = tuple(decision for planner in planners for decision in planner.decisions)
        return Unknown(task, analysis, str(doubt), decisions)


def _again(grasp: Grasp | Analysis, task: TimedTask) -> Outcome:
    """Plan a task on a grasp, which holds at the start what it says."""
    analysis = grasp if isinstance(grasp, Analysis) else analyse(grasp, NO_LOAD)
    return _planned(analysis, task, SOLVERS["clarabel"], brief=True)


def _refused(grasp: Grasp, task: TimedTask, analysis: Analysis, refusal: Refusal) -> Infeasible:
    certificate = refusal_certificate(task, analysis, refusal)
    if not certificate.verified:
        raise SelfCheckError(f"the refusal does not verify ({refusal}); please report this problem")
    known = None if isinstance(refusal, NotRestrainedError) else analysis
    return Infeasible(task, grasp, known, refusal.stage, str(refusal), refusal, certificate, None, (), None)
