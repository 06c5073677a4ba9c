"""Limits kept between the knots, and what a plan that keeps them, or the lack of one, then says of the task itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from synergrip.conic.formulation import Formulation
from synergrip.planning.instants import intersample_of
from synergrip.planning.outcome import Infeasible, Outcome, Plan, Unknown
from synergrip.statics.analysis import Analysis
from synergrip.tasks.timed_task import TimedTask

Answer = Callable[[TimedTask, Formulation], Outcome]
"""Plans a task in a formulation."""


def held(task: TimedTask, analysis: Analysis, formulation: Formulation, answer: Answer) -> Outcome:
    """Return the answer to a task, also in the cases that it allows for, and between the knots when it says so.

    Contacts that may be off are allowed for by a reserve in every cone, which asks for a little more than is needed,
    and scenarios by samples, all of which are more than the share that is asked: "infeasible" with them proves nothing.
    Then what is guaranteed is asked for by itself, every case with contacts off to either side.

    Args:
        task: with what is to happen between its knots.
        analysis: of the grasp.
        formulation: at the knots.
        answer: plans a task in a formulation.
    """
    outcome, allowed = _between(task, analysis, formulation, answer), formulation.allowed
    if allowed is None or not allowed.asks_more or not isinstance(outcome, Infeasible):
        return outcome
    without = _between(task, analysis, replace(formulation, allowed=allowed.exact), answer)
    if not isinstance(without, Plan) or (allowed.all_signs and not allowed.samples):
        return without
    if allowed.samples:
        why = (
            f"no plan keeps the limits in all {len(allowed.samples)} scenarios that allow.scenarios takes, and without "
            "them there is one: whether one keeps them for the share that is asked is not known"
        )
        return Unknown(task, analysis, why, (*outcome.decisions, *without.decisions))
    why = (
        "no plan keeps the limits with the reserve that allow.contact_gap takes, and without it, with one contact off "
        "at a time, there is one: whether one keeps them with all contacts off at once is not known"
    )
    return Unknown(task, analysis, why, (*outcome.decisions, *without.decisions))


def _between(task: TimedTask, analysis: Analysis, formulation: Formulation, answer: Answer) -> Outcome:
    """Return the answer to a task, whose limits are also kept between the knots when it says so.

    At the knots and the corners between them limits are asked for as they are. Where a load is curved, a reserve at
    both ends of a piece keeps them in between; it asks for more than is needed, so that "infeasible" with it proves
    nothing. Then the limits are asked for without it, at the knots and, where there is a plan of these, at every
    instant looked at: what is infeasible there, is.
    """
    intersample = intersample_of(task, analysis) if task.between == "hold" else None
    outcome = answer(task, formulation if intersample is None else replace(formulation, intersample=intersample))
    if intersample is None or intersample.exact or not isinstance(outcome, Infeasible):
        return outcome
    at_knots = answer(replace(task, between="report"), formulation)  # many times smaller
    if isinstance(at_knots, Infeasible):
        return replace(at_knots, task=task)
    without = answer(task, replace(formulation, intersample=intersample.every()))
    if isinstance(without, Infeasible | Unknown):
        return without
    why = (
        'no plan keeps the limits with the reserve at the knots that task.between = "hold" takes for a load that is '
        f"curved between them, and without it, at {intersample.samples} instants in each interval, there is one: "
        "whether one keeps them at all times is not known; more knots make the reserve smaller"
    )
    return Unknown(task, analysis, why, (*outcome.decisions, *without.decisions))
