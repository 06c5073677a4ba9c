"""From a walk to an answer: a plan whose figures are those of the hand that moves, or what keeps it from being one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from synergrip.documents.quantities import in_mm
from synergrip.grasps.facing import frame_notes
from synergrip.linalg import frozen
from synergrip.planning.accuracy import accuracy_notes
from synergrip.planning.beginning import walk_from_plan
from synergrip.planning.course import course_notes
from synergrip.planning.executed_cases import ExecutedCases, executed_cases, kept_in_cases
from synergrip.planning.executed_scenarios import Judged, in_scenarios
from synergrip.planning.executing import Executor
from synergrip.planning.figures import Figures, figures
from synergrip.planning.kept_between import MoreAtKnots
from synergrip.planning.known_samples import unseen
from synergrip.planning.let_go import undone_notes
from synergrip.planning.otherwise import walked_harder
from synergrip.planning.outcome import BETWEEN, Plan, Unknown
from synergrip.planning.pace import WHOLE, Effort
from synergrip.planning.reach import held_nowhere, hindrances, notes, off, reached_by
from synergrip.planning.rolling import rolling_notes
from synergrip.planning.runaway import answered
from synergrip.planning.solvers import Answerer
from synergrip.planning.springs import spring_notes
from synergrip.planning.until import figures_until, kept_until
from synergrip.planning.verified import passed_over
from synergrip.planning.walk import Walker
from synergrip.planning.walk_so_far import Walk


def on_the_hand(plan: Plan, answers: Answerer, effort: Effort = WHOLE) -> Plan | Unknown:
    """Return the answer at the true equilibria of the hand.

    Args:
        plan: for the start posture, on a hand.
        answers: the solver.
        effort: how much is tried.

    Raises:
        KeyboardInterrupt: what was found when somebody interrupted does not hold.
    """
    walker = Walker(plan.task, plan.analysis, Executor.of(plan.analysis, plan.task), answers, effort=effort)
    if plan.task.linearise == "along" and not plan.interrupted:
        judge = partial(answer_of, linear=plan)
        return answered(walker, lambda walker: _from_near(walker) or walk_from_plan(walker, plan.motion), judge)
    answer = _executed(walker.executed(plan.dz_r, plan.forces, plan.motion), walker, plan)
    if plan.interrupted and not isinstance(answer, Plan):
        raise KeyboardInterrupt
    return answer


def _from_near(walker: Walker) -> Walk | None:
    """Return the walk that passes from a motion near by end with; None where there is none, or not for this task."""
    near = walker.effort.near
    if near is None or not near.whole or not np.array_equal(near.times, walker.task.times):
        return None
    begun = walker.executed(near.references, None, near, fewer=True)
    return None if begun.way is None else walker.on(begun)


def _executed(walk: Walk, walker: Walker, plan: Plan) -> Plan | Unknown:
    """Return the plan of the start posture at its true states; unknown when these break what it promised."""
    if walk.way is None:
        k, executed = len(walk.executed.states), walk.executed
        why = f"executed, the plan of the start posture ends before t = {executed.times[k]:.3g} s: {executed.why}"
        got = figures_until(walk, walker, plan.formulation)
        return replace(_unknown(walker, plan, f"{why}; {ALONG}", walk, got), notes=tuple(kept_until(got, walker)))
    found = figures(walk, walker, plan.formulation, plan.between)
    said = found.said
    if (most := float(off(walk, walker).max())) > walker.allowed:
        strays = f"the object is up to {in_mm(most)} off the wanted motion"
        said = f"{said}; {strays}" if said else f"at the true equilibrium {strays}"
    cases = ExecutedCases() if said else executed_cases(walk, walker, plan.formulation)
    said = said or cases.said
    samples = Judged() if said else in_scenarios(walk, walker, plan.formulation, unseen())
    promised, kept = float(plan.margins.min()), float(found.usages[0].value.min())
    worth = (
        f"planned at the start posture, which promises a smallest slip margin of {promised:.4g} N; the hand that moves "
        f"keeps {kept:.4g} N"
    )
    if said := said or samples.said:
        return replace(_unknown(walker, plan, f"{said}; {ALONG}", walk, found), notes=(worth,))
    return _with(plan, walk, walker, found, cases, samples, (worth, *plan.notes))


SOON = "found as soon as limits hold along the motion: by its goals it may not be the best"
"""What is told of a plan that goes with a no."""
ALONG = 'task.linearise = "along" plans for the hand that moves'


def answer_of(walk: Walk, walker: Walker, linear: Plan) -> Plan | Unknown:
    """Return the plan that a walk ended with, at its true states; unknown when it did not reach or hold.

    Args:
        walk: what the passes ended with.
        walker: who walked.
        linear: the plan for the start posture, where the walk began.
    """
    if walk.interrupted:
        return _best_so_far(walk, walker, linear)
    if float(off(walk, walker).max()) > walker.allowed:
        return _not_reached(walk, walker, linear)
    if not walker.good(walk):
        why = f"after {walk.all_passes} passes what is promised and what the hand does still differ"
        why += f" by {walk.gap:.3g} N" if np.isfinite(walk.gap) else ", or an equilibrium is not found"
        found = None if walker.effort.brief else figures(walk, walker, linear.formulation, linear.between)
        return _unknown(walker, linear, why, walk, found)
    if walker.effort.brief and walk.short:
        why = f"along the motion the largest slip margin is less than the {walker.task.margin:.4g} N asked"
        return _unknown(walker, linear, why, walk)
    if (walk := walker.kept_between(walk)).interrupted:
        return _best_so_far(walk, walker, linear)
    walk = walker.to_all_digits(walk)
    found = figures(walk, walker, linear.formulation, linear.between)
    if kept := _with_more(walk, walker, found):
        return answer_of(*kept, linear)
    if said := found.said:
        inside = all(BETWEEN in check.name for check in found.checks if not check.passed)
        no = replace(_unknown(walker, linear, said, walk, found), between_only=inside)
        return _truer(walk, walker, linear) or no
    return _in_all_cases(walk, walker, linear, found)


def _not_reached(walk: Walk, walker: Walker, linear: Plan) -> Unknown:
    """Return that the object is not brought where it is wanted, or not held, with what is true until then."""
    reached = reached_by(walk, walker)
    found = figures_until(walk, walker, linear.formulation, reached.until_s)
    told = tuple(kept_until(found, walker))
    if not np.any(walker.wanted) or held_nowhere(walk, walker):
        when = f"{'after' if walker.arrived(walk) else 'at'} t = {reached.until_s:.3g} s"
        held = f"the hand that moves does not hold the object within its limits {when}"
        return replace(_unknown(walker, linear, f"{held}: {hindrances(walk, walker)}", walk, found), notes=told)
    answer = _unknown(walker, linear, reached.because, walk, found)
    return replace(answer, stage="reach", reached=reached, notes=told)


def _truer(walk: Walk, walker: Walker, linear: Plan) -> Plan | Unknown | None:
    """Return the answer of a walk gone on with until its promises are true; None where they are, or do not get so."""
    if walk.true:
        return None
    strict = replace(walker, effort=replace(walker.effort, strict=True))
    again = strict.on(walk)
    return answer_of(again, strict, linear) if again.true else None


def _in_all_cases(walk: Walk, walker: Walker, linear: Plan, found: Figures) -> Plan | Unknown:
    """Return the answer of a walk that holds as its task states it, in every case and in samples of its grasp."""
    formulation = linear.formulation
    cases = executed_cases(walk, walker, formulation)
    if cases.said:
        kept = kept_in_cases(walk, walker, formulation, cases)
        return _unknown(walker, linear, cases.said, walk, found) if kept is None else answer_of(*kept, linear)
    samples = in_scenarios(walk, walker, formulation)
    if samples.harder is not None:
        return answer_of(*samples.harder, linear)
    if samples.said:
        return _unknown(walker, linear, samples.said, walk, found)
    told = (
        *((SOON,) if walker.effort.brief else ()), *accuracy_notes(walker.start.response),
        *undone_notes(walker.start, walker.task), *_goal_notes(walk), *passed_over(found.between),
        *frame_notes(walker.start.grasp), *notes(walk, walker),
    )  # fmt: skip
    return _with(_decided(linear, walk), walk, walker, found, cases, samples, told)


def _with_more(walk: Walk, walker: Walker, found: Figures) -> tuple[Walk, Walker] | None:
    """Return a walk that asks for more at the knots for what limits miss between them; None when no such one helps.

    Where limits count at the knots only, it is for what they miss there by as much as promise and truth may differ.
    """
    counts = found.at_knots if walker.task.between == "report" or found.between is None else found.between
    more = walker.more or MoreAtKnots.none(walker.task, walker.start.grasp.n_c)
    if more.rounds >= walker.effort.harder:
        return None
    if (more_still := more.for_what_is_missing(counts, walker.task)) is None:
        return None
    return walked_harder(walk, replace(walker, more=more_still))


def _best_so_far(walk: Walk, walker: Walker, linear: Plan) -> Plan:
    """Return the plan that an interrupted walk has come to, when all that it asks holds at its true states.

    Raises:
        KeyboardInterrupt: it does not; with how far it had come.
    """
    come = f"{walk.come}, "
    if (most := float(off(walk, walker).max())) > walker.allowed:
        strays = f"the object is up to {in_mm(most)} off the wanted motion"
        raise KeyboardInterrupt(come + (strays if np.isfinite(most) else _until(walk, walker)))
    found = figures(walk, walker, linear.formulation, linear.between)
    missed = found.said
    cases = ExecutedCases() if missed else executed_cases(walk, walker, linear.formulation)
    missed = missed or cases.said
    if not missed and walker.task.allowed is not None and walker.task.allowed.scenarios is not None:
        missed = "it was not looked at which share of scenarios holds"
    if missed:
        raise KeyboardInterrupt(come + missed)
    note = f"interrupted {walk.come}; it holds, and may not be the best"
    plan = replace(_decided(linear, walk), interrupted=True)
    return _with(plan, walk, walker, found, cases, Judged(), (*_goal_notes(walk), note))


def _until(walk: Walk, walker: Walker) -> str:
    """Return until when a walk of fewer knots than the task has got."""
    if walk.until is None:
        return f"the hand does not get through all knots: {walk.executed.why}"
    where = f"until t = {walk.until:.3g} s" if walker.arrived(walk) else "at no knot yet"
    return f"the object is where it is wanted {where}"


def _decided(linear: Plan, walk: Walk) -> Plan:
    """Return the plan where a walk began with the decisions of the pass that it ended with."""
    return linear if walk.stage is None else replace(linear, decisions=(*linear.decisions, *walk.stage.decisions))


def _goal_notes(walk: Walk) -> tuple[str, ...]:
    """Return what is to be said of the goals of the pass that a walk ended with."""
    return () if walk.stage is None else walk.stage.notes


def _with(
    plan: Plan, walk: Walk, walker: Walker, found: Figures, cases: ExecutedCases, samples: Judged, told: Sequence[str]
) -> Plan:
    """Return a plan with the figures of a walk."""
    alpha, beta, gamma = walker.start.coordinates.coordinates(walk.references)
    fixed = walker.executor.with_fixed_contacts(walk.executed, walker.task.wrench)
    largest = None if plan.largest_margin is None else float(found.usages[0].value.min())
    return replace(
        plan, motion=found.motion, largest_margin=largest, alpha=frozen(alpha), beta=frozen(beta), gamma=frozen(gamma),
        margins=frozen(found.usages[0].value), usages=found.usages, between=found.between,
        executed=walk.executed, fixed=fixed, passes=walk.passes, first_passes=walk.first,
        notes=(*told, *course_notes(found.between, plan.task), *rolling_notes(walk.executed, fixed),
               *spring_notes(walk.executed, found.motion.torques, plan.task)),
        checks=(*found.checks, *cases.checks, *samples.checks), cases=cases.cases, fresh=samples.fresh,
        elastic_motion=found.elastic_motion,
    )  # fmt: skip


def _unknown(walker: Walker, linear: Plan, why: str, walk: Walk, found: Figures | None = None) -> Unknown:
    """Return that the hand does not do what a plan promises, with what it does."""
    decisions = (*linear.decisions, *walk.tried)
    answer = Unknown(walker.task, walker.start, why, decisions, "execution", passes=walk.all_passes)
    if found is None:
        return answer
    executed = walk.executed.first(len(found.motion.times))
    return replace(answer, executed=executed, motion=found.motion, usages=found.usages)
